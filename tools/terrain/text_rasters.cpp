#include "tools/terrain/text_rasters.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"
#include "tools/terrain/height_words.h"

namespace nightcity::terrain {
namespace {

constexpr std::string_view mark_of_utf8 = "\xef\xbb\xbf";

// Returns whether a line has two words that name the columns of a plan, as GDAL knows them.
bool names_columns(std::string_view line) {
  constexpr std::string_view between = " \t,;";
  bool has_x = false, has_y = false;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(between), line.size());
    const std::string word = to_lower(line.substr(0, end));
    has_x = has_x || word == "x" || word.starts_with("lon") || word.starts_with("east");
    has_y = has_y || word == "y" || word.starts_with("lat") || word.starts_with("north");
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return has_x && has_y;
}

// Takes comments off the beginning of a text, but for the sign of one that names columns, whose
// order it tells.
void drop_comments(std::string& start) {
  std::string headings;
  std::size_t at = 0;
  while (at < start.size() && start[at] == '#') {
    const std::size_t end = start.find_first_of("\r\n", at);
    if (end == std::string::npos) break;
    const std::string_view comment =
        city::trim(std::string_view(start).substr(at, end - at).substr(1));
    if (names_columns(comment)) headings = std::string(comment) + "\n";
    at = std::min(start.find_first_not_of("\r\n", end), start.size());
  }
  start.replace(0, at, headings);
}

}  // namespace

bool is_named_as_text_raster(std::string_view name) {
  constexpr std::array<std::string_view, 6> endings{".asc", ".xyz", ".txt", ".csv", ".dat", ".grd"};
  return city::ends_with_any(to_lower(name), endings);
}

bool is_odd_text(std::string_view start) {
  return start.starts_with(mark_of_utf8) || start.starts_with('#') || city::begins_as_utf16(start);
}

std::unique_ptr<city::ByteSource> straighten_text(std::unique_ptr<city::ByteSource> source) {
  constexpr std::size_t most_comments = 65536;
  source = city::to_utf8(std::move(source));
  std::string start = city::read_next(*source, most_comments);
  if (start.starts_with(mark_of_utf8)) start.erase(0, mark_of_utf8.size());
  drop_comments(start);
  const bool is_text = begins_as_text(start);
  source = city::resume(std::move(start), std::move(source));
  return is_text ? replace_height_words(std::move(source)) : std::move(source);
}

}  // namespace nightcity::terrain
