// Bounding volume hierarchies of the shaders' kind (BvhNode): built once for a mesh, and for the instances.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shaders/interface.h"

namespace nightcity {

struct Box {
  glm::vec3 lower{3.4e38f};
  glm::vec3 upper{-3.4e38f};

  void grow(const glm::vec3& p);
  void grow(const Box& b);
  float half_area() const;  // of a grown box; 0 for an empty one
  bool empty() const { return lower.x > upper.x; }
};

struct Bvh {
  std::vector<gpu::BvhNode>
      nodes;  // child indices are relative to this vector, leaf ranges to `order`
  std::vector<std::uint32_t> order;  // primitive at each leaf position
  std::uint32_t root = BVH_EMPTY;    // a node, a leaf, or BVH_EMPTY
  std::uint32_t stack_need = 0;      // entries a ray may have to defer
};

/// Binned surface-area heuristic, split straight into four, largest child first; object-median splits, whose
/// depth is logarithmic, wherever the rest would else need more than `max_stack` deferred entries. `masks`,
/// where there are any, one a box: what casts shadows is kept apart from what does not, and each node says
/// what is below. Throws Error when medians alone are too deep (needed_stack) or there are more than 134
/// million boxes. Boxes must be finite. `max_leaf` <= BVH_MAX_LEAF.
Bvh build_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t max_stack,
              std::span<const std::uint8_t> masks = {});

/// Entries that a hierarchy of object medians over so many boxes needs: the least that build_bvh can do with.
std::uint32_t needed_stack(std::size_t boxes, std::uint32_t max_leaf);

/// Adds `node_base` to inner children and `first_base` to leaf ranges, so that hierarchies can share one
/// buffer.
void rebase(Bvh& bvh, std::uint32_t node_base, std::uint32_t first_base);

}  // namespace nightcity
