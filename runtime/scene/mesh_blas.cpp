#include "runtime/scene/mesh_blas.h"

#include <span>

#include "runtime/scene/bvh.h"
#include "runtime/scene/stored_bvh.h"

namespace nightcity::scene {
namespace {

// Cutting takes twice the time to build, and some 100 bytes of memory a triangle meanwhile. A file
// that holds its hierarchies costs neither, however large the scene is.
constexpr std::size_t most_cut_here = 4'000'000;

BvhRoot add_mesh(RenderScene& scene, const TriangleRange& range, const BvhRoot& root) {
  if (range.first < range.end)
    scene.meshes.push_back({root.node, static_cast<std::uint32_t>(range.first),
                            static_cast<std::uint32_t>(range.end - range.first)});
  return root;
}

}  // namespace

void say_unused(RenderScene& scene, const std::string& fault) {
  if (scene.left_out.none())
    scene.unused_hierarchies.push_back("a stored hierarchy is not used, because " + fault);
}

BvhRoot add_blas(RenderScene& scene, const TriangleRange& range, unsigned threads,
                 std::uint32_t stack, const hierarchy::BoxFrame& frame) {
  const std::size_t position = scene.triangle_order.size();
  scene.triangle_order.resize(position + range.end - range.first);
  const BvhRoot root =
      append_bvh(scene.nodes, scene.triangles, range.first, triangle_leaf, stack, threads,
                 std::span(scene.triangle_order).subspan(position), frame, position - range.first);
  return add_mesh(scene, range, root);
}

std::optional<BvhRoot> add_static_blas(RenderScene& scene, const TriangleRange& range,
                                       VertexCheck vertices, unsigned threads,
                                       const StoredHierarchy* stored,
                                       const hierarchy::BoxFrame& frame) {
  const std::size_t count = range.end - range.first, position = scene.triangle_order.size();
  BvhRoot root;
  if (stored) {
    scene.triangle_order.resize(position + count + stored->count_cuts());
    const std::string fault = append_stored_bvh(
        scene.nodes, scene.triangles, range.first, *stored, triangle_leaf, mesh_stack, threads,
        std::span(scene.triangle_order).subspan(position), root, frame, position - range.first);
    if (fault.empty()) {
      ++scene.stored_hierarchies;
      return add_mesh(scene, range, root);
    }
    if (vertices == VertexCheck::later) return std::nullopt;
    say_unused(scene, fault);
    scene.triangle_order.resize(position);
  }
  if (count > most_cut_here) return add_blas(scene, range, threads, mesh_stack, frame);
  root = append_cut_bvh(scene.nodes, scene.triangles, range.first, count, triangle_leaf, mesh_stack,
                        threads, scene.triangle_order, frame);
  return add_mesh(scene, range, root);
}

}  // namespace nightcity::scene
