// Tests vectors for components that are no number, infinite or out of all proportion.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nightcity {

/// Returns whether no component is NaN or infinite.
template <class T>
bool finite(const glm::tvec2<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
template <class T>
bool finite(const glm::tvec3<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// No scene reaches farther. A ray traversal divides coordinates by components of directions, which
/// may be 1e-15 of the largest, and the quotients must be floats.
constexpr double max_coordinate_m = 1e15;

/// Returns whether every component lies within max_coordinate_m of 0; false for NaN.
template <class T>
bool is_within_reach(const glm::tvec3<T>& v) {
  return std::abs(v.x) <= max_coordinate_m && std::abs(v.y) <= max_coordinate_m &&
         std::abs(v.z) <= max_coordinate_m;
}

}  // namespace nightcity
