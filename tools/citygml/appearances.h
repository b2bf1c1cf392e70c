// Colours of an app:Appearance, by the id of the geometry that they colour: those of X3DMaterials
// and, on request, the means of textures and textures by the rings that they lie on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tools/city/skip_counter.h"

namespace nightcity::citygml {

class PictureColours;

/// A texture on a ring: the number of its picture, and its coordinates, the closing one with them.
struct RingTexture {
  std::uint32_t picture = 0;
  std::vector<glm::vec2> places;
};

class Materials {
 public:
  /// Textures give their surfaces a colour from now on, in place of a material's; `pictures` must
  /// outlive the object. Null: textures are counted as skipped.
  void set_pictures(PictureColours* pictures) { pictures_ = pictures; }
  /// Reads an app:Appearance, or a property that holds one. Everything else in it, such as
  /// textures, is counted in `skipped`.
  void read(const pugi::xml_node& appearance, city::SkipCounter& skipped);
  /// Returns sRGB as in the file; null when the id has no material. The first material of an id
  /// wins.
  const glm::vec3* find(std::string_view id) const;
  /// Returns the texture on the ring of this id; null where none was kept.
  const RingTexture* find_ring(std::string_view id) const;
  bool empty() const { return colours_.empty(); }

 private:
  void read_texture(const pugi::xml_node& texture, city::SkipCounter& skipped);
  void read_below(const pugi::xml_node& element, int depth, city::SkipCounter& skipped);

  /// By the id's hash: a city's ids themselves would fill the memory.
  std::unordered_map<std::size_t, glm::vec3> colours_;
  std::unordered_map<std::size_t, RingTexture> rings_;  // as colours_
  PictureColours* pictures_ = nullptr;
};

}  // namespace nightcity::citygml
