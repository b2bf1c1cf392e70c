// The frame that the boxes of a hierarchy lie along. Walls of a city follow its streets, and boxes
// along their direction hold less air than boxes along east and north: rays then visit fewer nodes.
// (Oriented boxes as in DOBB-BVH, CGF 2025, arXiv 2506.22849; but with one direction for the whole
// hierarchy, which costs a ray nothing.) Triangles stay where they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "formats/hierarchy/bounds.h"

namespace nightcity::hierarchy {

/// The corners of a triangle, m; 0 in the fourth places.
struct Corners {
  Float4 v0, v1, v2;

  Bounds bounds() const { return {min_of(min_of(v0, v1), v2), max_of(max_of(v0, v1), v2)}; }
};

/// The same in 36 bytes in place of 48, for the many that are kept.
class PackedCorners {
 public:
  PackedCorners() = default;
  explicit PackedCorners(const Corners& c) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Float4& from = i == 0 ? c.v0 : i == 1 ? c.v1 : c.v2;
      std::memcpy(&m_[3 * i], &from, 3 * sizeof(float));
    }
  }
  Corners unpack() const {
    const auto at = [this](std::size_t i) {
      return load_vec3(std::as_bytes(std::span(m_)).data() + 12 * i);
    };
    return {at(0), at(1), at(2)};
  }

 private:
  std::array<float, 9> m_;
};

struct BoxFrame {
  glm::vec2 along{1, 0};  // x and z of the unit vector that its x axis is; its y axis is y
  float margin_m = 0;     // by which its boxes are wider than what they hold

  bool is_turned() const { return along.y != 0 || along.x != 1; }
  /// Returns a point or a direction of the scene in this frame.
  glm::dvec3 turn(const glm::dvec3& v) const {
    const glm::dvec2 to(along);
    return {to.x * v.x + to.y * v.z, v.y, to.x * v.z - to.y * v.x};
  }
  Float4 turn(Float4 p) const {
    return Float4{along.x * p[0] + along.y * p[2], p[1], along.x * p[2] - along.y * p[0], 0};
  }
  Corners turn(const Corners& c) const {
    return is_turned() ? Corners{turn(c.v0), turn(c.v1), turn(c.v2)} : c;
  }
  /// Returns the box of a triangle in this frame, without margin.
  Bounds bounds_of(const Corners& c) const { return turn(c).bounds(); }
};

}  // namespace nightcity::hierarchy
