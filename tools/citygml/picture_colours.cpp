#include "tools/citygml/picture_colours.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "tools/city/attributes.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {
namespace {

// IEC 61966-2-1.
double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

glm::vec3 to_step(const glm::dvec3& linear) {
  constexpr double steps = 31;
  glm::vec3 colour;
  for (int i = 0; i < 3; ++i)
    colour[i] =
        static_cast<float>(std::round(std::clamp(to_srgb(linear[i]), 0.0, 1.0) * steps) / steps);
  return colour;
}

const std::string beyond_budget =
    std::string("texture: its picture is not unpacked: ") + picture_budget_text;

struct Span {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};
};

// The box of all texture coordinates in an element; of none: not finite.
Span find_span(const pugi::xml_node& target) {
  Span span;
  std::vector<double> numbers;
  for (const pugi::xml_node& list : target.children())
    for (const pugi::xml_node& child : list.children()) {
      if (local_name(child.name()) != "textureCoordinates") continue;
      numbers.clear();
      if (!read_numbers(child, numbers)) continue;
      for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
        const glm::dvec2 p(numbers[i], numbers[i + 1]);
        span.low = glm::min(span.low, p);
        span.high = glm::max(span.high, p);
      }
    }
  return span;
}

}  // namespace

PictureColours::PictureColours(const city::Document& document, bool latin1)
    : folder_(std::filesystem::path(document.name).parent_path()), plan_(document, latin1) {}

std::shared_ptr<const Picture> PictureColours::find_picture(std::string_view uri,
                                                            const char*& why) {
  why = "texture: its picture lies elsewhere";
  const auto file = find_picture_file(folder_, uri);
  if (!file) return {};
  {
    const std::lock_guard lock(mutex_);
    if (const auto* picture = recent_.find(*file)) return *picture;
  }
  why = "texture: its picture is not there";
  std::error_code error;
  if (!std::filesystem::is_regular_file(*file, error)) return {};
  why = "texture: its name is not written in one piece of text";
  const PicturePlan::Fate fate = plan_.find_fate(*file);
  if (fate == PicturePlan::Fate::unseen) return {};
  why = beyond_budget.c_str();
  if (fate == PicturePlan::Fate::beyond_budget) return {};
  why = "texture: its picture is no JPEG or PNG, or too large";
  std::optional<Picture> read;
  try {
    read = Picture::read(MappedFile(*file).bytes());
  } catch (const Error&) {
  }
  if (!read) return {};
  auto picture = std::make_shared<const Picture>(std::move(*read));
  ++pictures_;
  pixels_ += picture->count_pixels();
  const std::lock_guard lock(mutex_);
  recent_.add(*file, picture->count_pixels(), picture);
  return picture;
}

void PictureColours::read(const pugi::xml_node& texture, city::SkipCounter& skipped,
                          const std::function<void(std::string_view, const glm::vec3&)>& take) {
  std::string_view uri;
  std::vector<pugi::xml_node> targets;
  for (const pugi::xml_node& property : texture.children()) {
    const std::string_view name = local_name(property.name());
    if (name == "imageURI") uri = city::trim(property.child_value());
    if (name == "target") targets.push_back(property);
  }
  const char* why = "";
  const auto picture = find_picture(uri, why);
  if (!picture) {
    skipped.add(why);
    return;
  }
  for (const pugi::xml_node& target : targets) {
    std::string_view id = city::trim(find_attribute(target, "uri"));
    if (!id.starts_with('#')) continue;
    id.remove_prefix(1);
    const Span span = find_span(target);
    take(id, to_step(picture->find_mean_between(span.low, span.high)));
    ++surfaces_;
  }
}

}  // namespace nightcity::citygml
