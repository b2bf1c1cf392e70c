// The smallest rectangle round an outline.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

namespace nightcity::map_lights {

struct Box {
  glm::dvec2 centre{0, 0};
  glm::dvec2 along{1, 0};  // unit, the direction of the length
  double length_m = 0, width_m = 0;

  glm::dvec2 across() const { return {-along.y, along.x}; }
  /// Returns the place at shares of half the length and half the width from the centre.
  glm::dvec2 at(double u, double v) const {
    return centre + along * (u * length_m / 2) + across() * (v * width_m / 2);
  }
};

/// Returns the rectangle of least area round the points, which has an edge of their convex hull on
/// one of its sides (Freeman and Shapira 1975). Empty for points that are not finite or that all
/// lie in one place. The result does not depend on where the points begin.
std::optional<Box> find_box(std::span<const glm::dvec2> points);

}  // namespace nightcity::map_lights
