// Part of a triangle between planes across the axes (Sutherland, Hodgman: Reentrant polygon
// clipping, CACM 1974).
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "formats/hierarchy/box_frame.h"

namespace nightcity::hierarchy {

class Polygon {
 public:
  explicit Polygon(const Corners& triangle) {
    for (const Float4& corner : {triangle.v0, triangle.v1, triangle.v2})
      push({double(corner[0]), double(corner[1]), double(corner[2])});
  }

  bool empty() const { return count_ == 0; }
  Bounds bounds() const {
    Bounds box;
    for (std::size_t i = 0; i < count_; ++i)
      box.grow(Float4{float(corners_[i].x), float(corners_[i].y), float(corners_[i].z), 0});
    return box;
  }

  /// Leaves what lies on and above a plane, and returns what lies on and below it.
  Polygon cut_off_below(int axis, double plane) {
    Polygon below, above;
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::dvec3 &a = corners_[i], &b = corners_[i + 1 < count_ ? i + 1 : 0];
      const double from = a[axis] - plane, to = b[axis] - plane;
      if (from <= 0) below.push(a);
      if (from >= 0) above.push(a);
      if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
        glm::dvec3 crossing = a + (b - a) * (from / (from - to));
        crossing[axis] = plane;
        below.push(crossing);
        above.push(crossing);
      }
    }
    *this = above;
    return below;
  }

  /// Leaves what lies in a box.
  void keep_inside(const Bounds& box) {
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = double(box.lower[axis]), upper = double(box.upper[axis]);
      bool is_below = false, is_above = false;
      for (std::size_t i = 0; i < count_; ++i) {
        is_below = is_below || corners_[i][axis] < lower;
        is_above = is_above || corners_[i][axis] > upper;
      }
      if (is_below) cut_off_below(axis, lower);
      if (is_above) *this = cut_off_below(axis, upper);
    }
  }

 private:
  // Each of seven planes adds a corner to a convex polygon at most; the rest is room for corners
  // that rounding adds.
  static constexpr std::size_t most = 24;

  Polygon() = default;
  void push(const glm::dvec3& corner) {
    if (count_ < most) corners_[count_++] = corner;
  }

  std::array<glm::dvec3, most> corners_;
  std::size_t count_ = 0;
};

}  // namespace nightcity::hierarchy
