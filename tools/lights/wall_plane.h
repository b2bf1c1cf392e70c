// Polygons of a wall in the plane of the wall.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::lights {

struct WallFrame {
  glm::dvec3 origin{0}, normal{0}, along{0},
      up{0};  // orthonormal; along is horizontal, up leans with the wall

  glm::dvec2 to_plane(const glm::dvec3& p) const;
  glm::dvec3 from_plane(const glm::dvec2& p) const;
};

struct WallOutline {
  std::vector<glm::dvec2> exterior;
  std::vector<std::vector<glm::dvec2>> interiors;
  glm::dvec2 low{0}, high{0};
};

/// Returns the frame of a polygon that is upright enough for a wall; empty for others, slivers and
/// broken rings. `origin` is its first vertex.
std::optional<WallFrame> wall_frame(const city::Polygon& polygon);

WallOutline outline_in(const WallFrame& frame, const city::Polygon& polygon);

/// Returns whether the whole rectangle lies inside the outline and outside its holes.
bool contains(const WallOutline& outline, const glm::dvec2& low, const glm::dvec2& high);

}  // namespace nightcity::lights
