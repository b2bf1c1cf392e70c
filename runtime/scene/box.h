// Axis-aligned boxes.
#pragma once

#include <glm/vec3.hpp>

namespace nightcity::scene {

struct Box {
  glm::vec3 lower{3.4e38f};
  glm::vec3 upper{-3.4e38f};

  void grow(const glm::vec3& p);
  void grow(const Box& b);
  /// Returns half the surface area; 0 for an empty box.
  float half_area() const;
  bool empty() const { return lower.x > upper.x; }
};

}  // namespace nightcity::scene
