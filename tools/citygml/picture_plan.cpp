#include "tools/citygml/picture_plan.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <pugixml.hpp>
#include <system_error>
#include <vector>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "tools/city/attributes.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {
namespace {

constexpr std::string_view mark = "imageURI";
constexpr std::size_t max_element = 1 << 13;  // bytes of an imageURI with its tags
constexpr std::size_t block = 1 << 19;        // stays in the second cache

// Returns the name in the imageURI whose start tag holds `mark` at `at`; nothing at an end tag, or
// where the element is not whole.
std::optional<std::string> read_name(std::string_view text, std::size_t at, bool latin1) {
  const std::size_t open = text.rfind('<', at), behind = at + mark.size();
  if (open == std::string_view::npos || behind >= text.size() || !ends_name(text[behind]))
    return std::nullopt;
  if (local_name(text.substr(open + 1, behind - open - 1)) != mark || text[open + 1] == '/')
    return std::nullopt;
  const std::size_t close = text.find("</", behind), end = text.find('>', close);
  if (close == std::string_view::npos || end == std::string_view::npos) return std::nullopt;
  pugi::xml_document xml;
  if (!xml.load_buffer(text.data() + open, end + 1 - open, gml_parse_flags,
                       latin1 ? pugi::encoding_latin1 : pugi::encoding_utf8))
    return std::nullopt;
  return std::string(city::trim(xml.document_element().child_value()));
}

// Calls `take` with every name in the document, in its order.
void for_each_name(const city::Document& document, bool latin1,
                   const std::function<void(std::string_view)>& take) {
  const auto source = document.open();
  std::string window;
  std::size_t passed = 0;
  for (bool more = true; more;) {
    const std::size_t kept = window.size();
    window.resize(kept + block);
    const std::size_t got = source->read(window.data() + kept, block);
    window.resize(kept + got);
    more = got > 0 && !std::memchr(window.data() + kept, 0, got);
    while (const void* found =
               ::memmem(window.data() + passed, window.size() - passed, mark.data(), mark.size())) {
      const auto at = static_cast<std::size_t>(static_cast<const char*>(found) - window.data());
      if (more && window.size() - at < max_element) break;  // it may end in the next block
      const std::size_t from = at - std::min(at, max_element);
      if (const auto name =
              read_name(std::string_view(window).substr(from, 2 * max_element), at - from, latin1))
        take(*name);
      passed = at + mark.size();
    }
    const std::size_t gone = window.size() - std::min(window.size(), 2 * max_element);
    window.erase(0, gone);
    passed = std::max(passed, gone) - gone;
  }
}

struct Named {
  std::filesystem::path file;
  std::size_t bytes;
  std::int64_t pixels, unpacked;  // of one, and of all times that it is unpacked
};

// Returns nothing for what is no picture: it costs nothing.
std::optional<Named> look_at(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  try {
    const MappedFile mapped(file);
    const auto pixels = count_picture_pixels(mapped.bytes());
    if (pixels && *pixels <= max_picture_pixels)
      return Named{file, mapped.bytes().size(), *pixels, 0};
  } catch (const Error&) {  // PictureColours counts it
  }
  return std::nullopt;
}

}  // namespace

PicturePlan::PicturePlan(const city::Document& document, bool latin1) {
  const std::filesystem::path folder = std::filesystem::path(document.name).parent_path();
  std::vector<Named> pictures;
  std::unordered_map<std::string, std::optional<std::size_t>> numbers;
  RecentPictures<bool> recent;
  for_each_name(document, latin1, [&](std::string_view uri) {
    const auto file = find_picture_file(folder, uri);
    if (!file) return;
    const auto [number, added] = numbers.try_emplace(file->native());
    if (added) {
      fates_[file->native()] = Fate::unpacked;
      if (auto picture = look_at(*file)) {
        number->second = pictures.size();
        pictures.push_back(std::move(*picture));
      }
    }
    if (!number->second || recent.find(*file)) return;
    Named& picture = pictures[*number->second];
    picture.unpacked += picture.pixels;
    recent.add(*file, picture.pixels, true);
  });
  PictureBudget budget;
  for (const Named& picture : pictures)
    if (!budget.take(picture.unpacked, picture.bytes))
      fates_[picture.file.native()] = Fate::beyond_budget;
}

}  // namespace nightcity::citygml
