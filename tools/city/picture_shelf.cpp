#include "tools/city/picture_shelf.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "formats/srgb.h"

namespace nightcity::city {
namespace {

const std::string beyond_budget =
    std::string("texture: its picture is not unpacked: ") + picture_budget_text;
constexpr const char* no_picture = "texture: its picture is no JPEG or PNG, or too large";

}  // namespace

std::optional<std::filesystem::path> find_picture_file(const std::filesystem::path& folder,
                                                       std::string_view uri) {
  std::string written(uri);
  std::replace(written.begin(), written.end(), '\\', '/');
  const std::filesystem::path name(written);
  if (name.empty() || name.is_absolute() || written.find("://") != std::string::npos) return {};
  if (std::find(name.begin(), name.end(), "..") != name.end()) return {};
  return folder / name;
}

glm::vec3 find_mean_step(const Picture& picture, const glm::dvec2& low, const glm::dvec2& high) {
  constexpr double steps = 31;
  const glm::dvec3 linear = picture.find_mean_between(low, high);
  glm::vec3 colour;
  for (int i = 0; i < 3; ++i)
    colour[i] = static_cast<float>(
        std::round(std::clamp(srgb_from_linear(linear[i]), 0.0, 1.0) * steps) / steps);
  return colour;
}

PictureShelf::PictureShelf(const std::filesystem::path& document, std::vector<std::string> names) {
  PictureBudget budget;
  for (const std::string& name : names) {
    Entry& entry = entries_.emplace_back(Entry{{}, "texture: its picture lies elsewhere"});
    const auto file = find_picture_file(document.parent_path(), name);
    if (!file) continue;
    entry.file = *file;
    entry.fault = "texture: its picture is not there";
    std::error_code error;
    if (!std::filesystem::is_regular_file(*file, error)) continue;
    entry.fault = no_picture;
    try {
      const MappedFile mapped(*file);
      const auto pixels = count_picture_pixels(mapped.bytes());
      if (!pixels || *pixels > max_picture_pixels) continue;
      entry.fault = budget.take(*pixels, mapped.bytes().size()) ? nullptr : beyond_budget.c_str();
    } catch (const Error&) {
    }
  }
}

std::shared_ptr<const Picture> PictureShelf::find(std::size_t number, const char*& why) {
  why = "texture: its picture is not in the list";
  if (number >= entries_.size()) return {};
  const Entry& entry = entries_[number];
  why = entry.fault;
  if (why) return {};
  {
    const std::lock_guard lock(mutex_);
    if (const auto* picture = recent_.find(entry.file)) return *picture;
  }
  why = no_picture;
  std::optional<Picture> read;
  try {
    read = Picture::read(MappedFile(entry.file).bytes());
  } catch (const Error&) {
  }
  if (!read) return {};
  auto picture = std::make_shared<const Picture>(std::move(*read));
  const std::lock_guard lock(mutex_);
  recent_.add(entry.file, picture->count_pixels(), picture);
  return picture;
}

}  // namespace nightcity::city
