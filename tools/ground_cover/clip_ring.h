// Cuts outlines to rectangles.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace nightcity::ground_cover {

/// Returns the part of an open ring within a rectangle (Sutherland, Hodgman 1974). A ring that
/// enters the rectangle several times stays one ring, whose parts are joined along the rectangle's
/// sides; empty where nothing is left.
std::vector<glm::dvec2> clip_ring(const std::vector<glm::dvec2>& ring, const glm::dvec2& low,
                                  const glm::dvec2& high);

}  // namespace nightcity::ground_cover
