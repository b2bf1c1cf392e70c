#include "tools/georeference/right_angles.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace nightcity::georeference {
namespace {

bool is_right_angle(const glm::dvec2& a, const glm::dvec2& b) {
  constexpr double max_cosine = 0.0175;  // within one degree
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0 && std::abs(glm::dot(a, b)) < max_cosine * lengths;
}

}  // namespace

RightAngles count_right_angles(std::span<const glm::dvec3> closed_rings) {
  constexpr double radians = std::numbers::pi / 180;
  constexpr double max_edge_degrees = 0.01;  // about 1 km: the jump to the next ring is no edge
  RightAngles count;
  for (std::size_t i = 1; i + 1 < closed_rings.size(); ++i) {
    const glm::dvec2 corner(closed_rings[i]), a = corner - glm::dvec2(closed_rings[i - 1]),
                                              b = glm::dvec2(closed_rings[i + 1]) - corner;
    if (!(glm::length(a) < max_edge_degrees && glm::length(b) < max_edge_degrees)) continue;
    const glm::dvec2 by_y(std::cos(corner.y * radians), 1), by_x(1, std::cos(corner.x * radians));
    count.y_is_latitude += is_right_angle(a * by_y, b * by_y);
    count.x_is_latitude += is_right_angle(a * by_x, b * by_x);
  }
  return count;
}

}  // namespace nightcity::georeference
