#include "tools/citygml/picture_colours.h"

#include <algorithm>
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

const std::string beyond_budget =
    std::string("texture: its picture is not unpacked: ") + picture_budget_text;

struct Span {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};
};

// A surface or ring group that a texture lies on: its id, and the element that holds its
// coordinate lists.
struct Target {
  std::string_view id;
  pugi::xml_node holder;
};

std::string_view to_id(std::string_view uri) {
  uri = city::trim(uri);
  return uri.starts_with('#') ? uri.substr(1) : std::string_view();
}

// Appends what a property of a ParameterizedTexture names: CityGML 1 and 2 have target, 3 has
// textureParameterization with a TextureAssociation in it.
void append_targets(const pugi::xml_node& property, std::vector<Target>& targets) {
  const std::string_view name = local_name(property.name());
  if (name == "target") targets.push_back({to_id(find_attribute(property, "uri")), property});
  if (name != "textureParameterization") return;
  for (const pugi::xml_node& association : property.children()) {
    Target target;
    for (const pugi::xml_node& child : association.children()) {
      if (local_name(child.name()) == "target") target.id = to_id(child.child_value());
      if (local_name(child.name()) == "textureParameterization") target.holder = child;
    }
    if (target.holder) targets.push_back(target);
  }
}

// The box of all texture coordinates of a target; of none: not finite.
Span find_span(const pugi::xml_node& holder) {
  Span span;
  std::vector<double> numbers;
  for (const pugi::xml_node& list : holder.children())
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

using TakeRing = std::function<void(std::string_view, RingTexture&&)>;

// Calls `take` for each ring of a TexCoordList that has an id and coordinates. CityGML 1 and 2 name
// the ring in an attribute; 3 has elements for the rings, in the order of their coordinates.
void for_each_ring(const pugi::xml_node& list, std::uint32_t picture, const TakeRing& take) {
  std::vector<std::string_view> rings;
  for (const pugi::xml_node& child : list.children())
    if (local_name(child.name()) == "ring") rings.push_back(to_id(child.child_value()));
  std::size_t number = 0;
  std::vector<double> numbers;
  for (const pugi::xml_node& child : list.children()) {
    if (local_name(child.name()) != "textureCoordinates") continue;
    std::string_view ring = to_id(find_attribute(child, "ring"));
    if (ring.empty() && number < rings.size()) ring = rings[number];
    ++number;
    numbers.clear();
    if (ring.empty() || !read_numbers(child, numbers)) continue;
    RingTexture texture{picture, {}};
    texture.places.reserve(numbers.size() / 2);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
      texture.places.emplace_back(numbers[i], numbers[i + 1]);
    take(ring, std::move(texture));
  }
}

}  // namespace

void PolygonTexture::add(const RingTexture* texture, std::size_t vertices) {
  if (!is_whole_) return;
  is_whole_ = texture && texture->places.size() == vertices + 1 &&
              (places_.empty() || texture->picture == picture_);
  is_misfit_ = is_misfit_ || (texture && texture->places.size() != vertices + 1);
  if (!is_whole_) return;
  picture_ = texture->picture;
  places_.insert(places_.end(), texture->places.begin(), texture->places.end() - 1);
}

std::shared_ptr<const city::SurfacePicture> PolygonTexture::cut(PictureColours& pictures,
                                                                city::SkipCounter& skipped,
                                                                std::int64_t& pixels_left) const {
  const auto picture = pictures.find_picture(picture_);
  if (!picture) return {};
  auto part = city::cut_picture(*picture, places_, pixels_left);
  if (part)
    pictures.count_laid_out();
  else
    skipped.add(city::texture_not_cut);
  return part;
}

PictureColours::PictureColours(const city::Document& document, bool latin1, city::Textures textures)
    : textures_(textures),
      folder_(std::filesystem::path(document.name).parent_path()),
      plan_(document, latin1) {}

std::uint32_t PictureColours::find_number(std::string_view uri) {
  const std::lock_guard lock(mutex_);
  const auto [at, is_new] =
      numbers_.try_emplace(std::string(uri), static_cast<std::uint32_t>(uris_.size()));
  if (is_new) uris_.emplace_back(uri);
  return at->second;
}

std::shared_ptr<const Picture> PictureColours::find_picture(std::uint32_t number) {
  std::string uri;
  {
    const std::lock_guard lock(mutex_);
    uri = uris_.at(number);
  }
  const char* why = "";
  return find_picture(uri, why);
}

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
  const std::lock_guard lock(mutex_);
  recent_.add(*file, picture->count_pixels(), picture);
  return picture;
}

void PictureColours::read(const pugi::xml_node& texture, city::SkipCounter& skipped,
                          const std::function<void(std::string_view, const glm::vec3&)>& take,
                          const std::function<void(std::string_view, RingTexture&&)>& take_ring) {
  std::string_view uri;
  std::vector<Target> targets;
  for (const pugi::xml_node& property : texture.children()) {
    const std::string_view name = local_name(property.name());
    if (name == "imageURI") uri = city::trim(property.child_value());
    append_targets(property, targets);
  }
  const char* why = "";
  const auto picture = find_picture(uri, why);
  if (!picture) {
    skipped.add(why);
    return;
  }
  if (keeps_pictures())
    for (const Target& target : targets)
      for (const pugi::xml_node& list : target.holder.children())
        for_each_ring(list, find_number(uri), take_ring);
  for (const Target& target : targets) {
    if (target.id.empty()) continue;
    const Span span = find_span(target.holder);
    take(target.id, city::find_mean_step(*picture, span.low, span.high));
    ++surfaces_;
  }
}

}  // namespace nightcity::citygml
