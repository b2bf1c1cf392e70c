// Boxes for tests of hierarchies: scattered ones, and those that nodes hold.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "runtime/scene/box.h"
#include "shaders/bvh_types.h"

namespace nightcity::scene {

/// Returns boxes of up to `most` m a side, whose corners lie within `spread` of the origin, and up to
/// 30 m high.
inline std::vector<Box> random_boxes(std::size_t count, float spread, unsigned seed,
                                     float most = 5) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    const glm::vec3 p(uniform(-spread, spread), uniform(0, 30), uniform(-spread, spread));
    box.grow(p);
    box.grow(p + glm::vec3(uniform(0, most), uniform(0, most), uniform(0, most)));
  }
  return boxes;
}

/// Returns the box that a node holds of its child.
inline Box find_box(const gpu::BvhNode& node, std::size_t child) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const float step = std::ldexp(1.0f, int((node.exponents >> (8 * axis)) & 255u) - 127);
    box.lower[axis] = node.origin[axis] + float((node.lower[axis] >> (8 * child)) & 255u) * step;
    box.upper[axis] = node.origin[axis] + float((node.upper[axis] >> (8 * child)) & 255u) * step;
  }
  return box;
}

}  // namespace nightcity::scene
