// The properties that the picture of each polygon has, whatever file it comes from.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>

#include "tools/city/city_model.h"

namespace nightcity::test {

/// Returns whether a polygon has no picture, or one with three bytes for each of its pixels, a
/// place in it for each vertex, and a colour.
inline bool has_sound_picture(const city::Polygon& polygon) {
  if (!polygon.picture) return true;
  const city::SurfacePicture& picture = *polygon.picture;
  if (picture.width < 1 || picture.height < 1 || !polygon.diffuse_colour) return false;
  const auto width = static_cast<std::size_t>(picture.width),
             height = static_cast<std::size_t>(picture.height);
  std::size_t vertices = polygon.exterior.size();
  for (const city::Ring& ring : polygon.interiors) vertices += ring.size();
  if (picture.rgb.size() != 3 * width * height || picture.places.size() != vertices) return false;
  constexpr double rounding = 1e-6;  // pixels
  for (const glm::dvec2& p : picture.places)
    if (!(p.x >= -rounding && p.y >= -rounding && p.x <= picture.width + rounding &&
          p.y <= picture.height + rounding))
      return false;
  for (int c = 0; c < 3; ++c)
    if (!((*polygon.diffuse_colour)[c] >= 0 && (*polygon.diffuse_colour)[c] <= 1)) return false;
  return true;
}

}  // namespace nightcity::test
