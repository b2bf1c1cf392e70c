#include "runtime/scene/light_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "runtime/scene/box.h"

namespace nightcity::scene {
namespace {

// Spreads the lower 21 bits so that two zeros follow each.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x1F00000000FFFF;
  x = (x | x << 16) & 0x1F0000FF0000FF;
  x = (x | x << 8) & 0x100F00F00F00F00F;
  x = (x | x << 4) & 0x10C30C30C30C30C3;
  return (x | x << 2) & 0x1249249249249249;
}

// Returns the place of a point on the Morton curve through the cube at `lower` with this side.
std::uint64_t morton_code(const glm::vec3& point, const glm::vec3& lower, float side) {
  const glm::vec3 share = (point - lower) / side;
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(double(share[axis]), 0.0, 1.0) * 2097151.0;
    code |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return code;
}

gpu::LightNode join(std::span<const gpu::LightNode> nodes) {
  gpu::LightNode all{nodes[0].lower, 0, nodes[0].upper, NO_HIT};
  for (const gpu::LightNode& node : nodes) {
    all.lower = glm::min(all.lower, node.lower);
    all.upper = glm::max(all.upper, node.upper);
    all.flux_lm += node.flux_lm;
  }
  return all;
}

// Returns the box around a light as a leaf.
gpu::LightNode leaf_of(const Light& light, std::uint32_t index) {
  const float radius = light_kind(light) == LightKind::rectangle
                           ? std::hypot(half_width(light), light.half_height)
                           : light.radius;
  return {light.position - radius, light.flux_lm, light.position + radius, index};
}

}  // namespace

LightTree build_light_tree(std::span<const Light> lights, std::span<const std::uint32_t> lit) {
  LightTree tree;
  tree.leaf_of_light.resize(std::max<std::size_t>(lights.size(), 1));  // no buffer is empty
  tree.nodes.resize(lit.empty() ? 1 : 0);
  if (lit.empty()) return tree;
  Box box;
  for (const std::uint32_t light : lit) box.grow(lights[light].position);
  const glm::vec3 size = box.upper - box.lower;
  const float side = std::max({size.x, size.y, size.z, 1e-3f});
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(lit.size());
  for (const std::uint32_t light : lit)
    order.emplace_back(morton_code(lights[light].position, box.lower, side), light);
  std::sort(order.begin(), order.end());
  tree.nodes.reserve(lit.size() * 4 / 3 + LIGHT_TREE_LEVELS);
  for (const auto& [code, light] : order) {
    tree.leaf_of_light[light] = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back(leaf_of(lights[light], light));
  }
  std::size_t first = 0, count = lit.size();
  for (std::uint32_t level = 0;; ++level) {
    tree.shape.level_first[level] = static_cast<std::uint32_t>(first);
    tree.shape.level_count[level] = static_cast<std::uint32_t>(count);
    tree.shape.levels = level + 1;
    if (count == 1) return tree;
    for (std::size_t i = 0; i < count; i += 4)
      tree.nodes.push_back(
          join(std::span(tree.nodes).subspan(first + i, std::min<std::size_t>(4, count - i))));
    first += count;
    count = tree.nodes.size() - first;
  }
}

}  // namespace nightcity::scene
