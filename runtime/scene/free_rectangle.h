// A rectangle of the map that triangles leave free.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nightcity::scene {

/// An axis-aligned rectangle in x and z, m. Triangles that reach into it take a side off it.
class FreeRectangle {
 public:
  FreeRectangle(const glm::vec2& lower, const glm::vec2& upper) : lower_(lower), upper_(upper) {}

  /// Makes the rectangle smaller, so that the triangle does not reach into it: of the four ways to
  /// move one side, by that which leaves the largest area. Its corners are finite.
  void leave_out(const std::array<glm::vec3, 3>& triangle);

  bool empty() const { return !(lower_.x < upper_.x && lower_.y < upper_.y); }
  const glm::vec2& lower() const { return lower_; }
  const glm::vec2& upper() const { return upper_; }

 private:
  glm::vec2 lower_, upper_;
};

}  // namespace nightcity::scene
