#include "runtime/scene/box.h"

#include <glm/common.hpp>

namespace nightcity::scene {

void Box::grow(const glm::vec3& p) {
  lower = glm::min(lower, p);
  upper = glm::max(upper, p);
}

void Box::grow(const Box& b) {
  lower = glm::min(lower, b.lower);
  upper = glm::max(upper, b.upper);
}

float Box::half_area() const {
  if (empty()) return 0;
  const glm::vec3 s = upper - lower;
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

}  // namespace nightcity::scene
