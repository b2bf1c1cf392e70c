// Finds out from a file's rings alone which of two coordinates in degrees is the latitude.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace nightcity::georeference {

/// Counts the corners of rings that are right angles, to one degree, when coordinates are degrees:
/// y the latitude (first) or x (second). A degree of longitude is shorter than one of latitude by
/// the latitude's cosine, and buildings are mostly rectangular, so only the true order shows right
/// angles, save those along the axes, which both orders show. `closed_rings`: as for handedness().
struct RightAngles {
  std::size_t y_is_latitude = 0, x_is_latitude = 0;
};
RightAngles count_right_angles(std::span<const glm::dvec3> closed_rings);

}  // namespace nightcity::georeference
