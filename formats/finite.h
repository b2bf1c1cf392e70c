// Tests vectors for components that are NaN or infinite.
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

}  // namespace nightcity
