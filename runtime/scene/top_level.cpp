#include "runtime/scene/top_level.h"

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "formats/hierarchy/static_geometry.h"
#include "runtime/scene/bvh.h"
#include "runtime/scene/free_rectangle.h"
#include "runtime/scene/insert_leaves.h"
#include "runtime/scene/mesh_blas.h"
#include "runtime/scene/quantised_nodes.h"

namespace nightcity::scene {
namespace {

// Rays that go into an instance still have what they deferred before. So only instances in which
// they defer little are put below static triangles: those of up to some 100,000 triangles.
constexpr std::uint32_t most_inside = 24;

// More instances than a city has trees would take seconds.
constexpr std::size_t most_inserted = 1 << 18;
// With room for fewer entries, leaves would lie so high up that they cost more than a hierarchy of
// their own.
constexpr std::uint32_t least_room = 12;

bool may_be_inserted(const TopPart& part) {
  return !part.is_static && (part.instance.mask & MASK_SHADOW) != 0 &&
         part.stack_need <= most_inside;
}

// Returns the leaf of the instance that will be appended next.
std::uint32_t make_next_leaf(const RenderScene& out) {
  return static_cast<std::uint32_t>(BVH_LEAF | BVH_INSTANCE | out.instances.size());
}

// Builds a TLAS in which a ray may have to defer `stack` entries, appends the instances in its
// order, and returns its root.
std::uint32_t add_tlas(RenderScene& out, const std::vector<TopPart>& parts, std::uint32_t stack,
                       unsigned threads) {
  std::vector<Box> boxes;
  std::vector<std::uint8_t> masks;
  for (const TopPart& part : parts) {
    boxes.push_back(part.box);
    masks.push_back(static_cast<std::uint8_t>(part.instance.mask));
  }
  const Bvh top = build_bvh(boxes, 1, stack, masks, threads);
  const auto base = static_cast<std::uint32_t>(out.nodes.size());
  // A leaf stands for a part, whose root or instance takes its place.
  const auto find_child = [&](std::uint32_t child) {
    if (child == BVH_EMPTY) return child;
    if (!(child & BVH_LEAF)) return child + base;
    const TopPart& part = parts[top.order[child & BVH_LEAF_FIRST_MASK]];
    if (part.is_static) return part.root;
    const std::uint32_t leaf = make_next_leaf(out);
    out.instances.push_back(part.instance);
    return leaf;
  };
  for (gpu::BvhNode node : top.nodes) {
    for (std::uint32_t& child : node.child) child = find_child(child);
    out.nodes.push_back(node);
  }
  return find_child(top.root);
}

// Puts instances that cast shadows into the hierarchy of the static triangles that do, and takes
// them off the parts. Returns how many entries a ray may have to defer in a TLAS over the others.
std::uint32_t insert_instances(RenderScene& out, std::vector<TopPart>& parts) {
  const auto holds_casters = [](const TopPart& part) {
    return part.is_static && (part.instance.mask & MASK_SHADOW) != 0 && !(part.root & BVH_LEAF);
  };
  const auto into = std::find_if(parts.begin(), parts.end(), holds_casters);
  if (into == parts.end()) return tlas_stack;
  std::vector<TopPart> others, inserted;
  std::uint32_t inside = 0;
  for (const TopPart& part : parts) {
    if (may_be_inserted(part)) inside = std::max(inside, part.stack_need);
    (may_be_inserted(part) ? inserted : others).push_back(part);
  }
  // One entry is for the other child of the root above the static scene and the vehicles.
  const std::uint32_t taken = 1 + into->stack_need + inside, least = needed_stack(others.size(), 1);
  if (inserted.empty() || inserted.size() > most_inserted || taken + least + least_room > BVH_STACK)
    return tlas_stack;
  LeafInserter inserter(out.nodes, into->root, BVH_STACK - taken - least);
  Box box = into->box;
  const std::size_t before = out.instances.size();
  for (const TopPart& part : inserted) {
    if (!inserter.insert(make_next_leaf(out), to_bounds(part.box))) {
      others.push_back(part);
      continue;
    }
    out.instances.push_back(part.instance);
    box.grow(part.box);
  }
  const std::uint32_t left = BVH_STACK - taken - inserter.deferred();
  if (needed_stack(others.size(), 1) > left) {  // too many that found no place
    out.instances.resize(before);
    return tlas_stack;
  }
  inserter.finish();
  std::find_if(others.begin(), others.end(), holds_casters)->box = box;
  parts = std::move(others);
  return std::min(tlas_stack, left);
}

}  // namespace

glm::dmat4 find_to_scene(const gpu::Instance& instance) {
  glm::dmat4 to_object(1);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      to_object[column][row] = double(instance.to_object[row][column]);
  return glm::inverse(to_object);
}

void add_top_level(RenderScene& out, std::vector<TopPart> parts, unsigned threads) {
  for (const TopPart& part : parts) out.root_box.grow(part.box);
  const std::uint32_t stack = insert_instances(out, parts);
  out.root = add_tlas(out, parts, stack, threads);
}

void add_horizon(RenderScene& out, const std::vector<TopPart>& parts, unsigned threads) {
  if (parts.empty()) return;
  out.horizon.root = add_tlas(out, parts, tlas_stack, threads);
  out.horizon.top = parts.front().box.upper.y;
  for (const TopPart& part : parts) out.horizon.top = std::max(out.horizon.top, part.box.upper.y);
  FreeRectangle free({out.bounds.lower.x, out.bounds.lower.z},
                     {out.bounds.upper.x, out.bounds.upper.z});
  for (const TopPart& part : parts) {
    const glm::dmat4 to_scene = find_to_scene(part.instance);
    const auto mesh = std::find_if(out.meshes.begin(), out.meshes.end(),
                                   [&](const Mesh& m) { return m.root == part.root; });
    for (std::uint32_t i = 0; i < mesh->triangles; ++i) {
      const gpu::Triangle triangle = out.triangles[mesh->first_triangle + i];
      free.leave_out({hierarchy::place(to_scene, triangle.v0),
                      hierarchy::place(to_scene, triangle.v1),
                      hierarchy::place(to_scene, triangle.v2)});
    }
  }
  if (free.empty()) return;
  out.horizon.lower = free.lower();
  out.horizon.upper = free.upper();
}

}  // namespace nightcity::scene
