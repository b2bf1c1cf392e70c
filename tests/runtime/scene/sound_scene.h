// Checks that hold for every scene, broken or not: for the fuzz target and the test of its corpus.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/hierarchy/child.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::test {

/// Returns why a scene cannot be traced; "" where it can: its triangles are finite, each is in a
/// leaf, and nodes and instances name what is there.
inline std::string find_fault_of_hierarchies(const scene::RenderScene& scene) {
  std::vector<bool> is_in_leaf(scene.triangles.size());
  for (const std::uint32_t triangle : scene.triangle_order) {
    if (triangle >= is_in_leaf.size()) return "a leaf names a triangle that is not there";
    is_in_leaf[triangle] = true;
  }
  for (std::size_t i = 0; i < is_in_leaf.size(); ++i) {
    const gpu::Triangle t = scene.triangles[i];
    if (!is_in_leaf[i]) return "a triangle is in no leaf";
    if (!is_within_reach(t.v0) || !is_within_reach(t.v1) || !is_within_reach(t.v2))
      return "a corner";
  }
  const auto is_there = [&](std::uint32_t child) {
    if (child == BVH_EMPTY) return true;
    if (!hierarchy::is_leaf(child)) return child < scene.nodes.size();
    return hierarchy::first_of_leaf(child) + hierarchy::size_of_leaf(child) <=
           std::max(scene.triangle_order.size(), scene.instances.size());
  };
  for (const gpu::BvhNode& node : scene.nodes)
    if (!std::all_of(std::begin(node.child), std::end(node.child), is_there)) return "a child";
  for (const gpu::Instance& instance : scene.instances)
    if (!is_there(instance.root)) return "an instance";
  return "";
}

/// Returns what is wrong with how a file is loaded; "" where it is sound, or refused with a reason.
inline std::string find_fault_of_scene(const std::filesystem::path& glb) {
  try {
    return find_fault_of_hierarchies(scene::load_render_scene(glb));
  } catch (const Error& error) {
    return std::string(error.what()).empty() ? "an error without words" : "";
  }
}

}  // namespace nightcity::test
