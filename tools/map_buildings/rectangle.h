// The rectangle that lies closest round an outline.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace nightcity::map_buildings {

struct Rectangle {
  glm::dvec2 along{1, 0};  // of the longer side
  glm::dvec2 middle{0, 0};
  double length = 0, width = 0;
};

/// Returns the rectangle of least area round a ring, in metres: one of its sides lies on an edge of
/// the convex hull (Freeman and Shapira 1975), and edges of the outline itself are enough for
/// buildings.
Rectangle find_rectangle(const std::vector<glm::dvec2>& ring);

}  // namespace nightcity::map_buildings
