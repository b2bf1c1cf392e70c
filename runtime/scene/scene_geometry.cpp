#include "runtime/scene/scene_geometry.h"

#include <algorithm>
#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <span>
#include <utility>

#include "formats/finite.h"
#include "formats/hierarchy/cutting_build.h"
#include "formats/hierarchy/static_geometry.h"
#include "runtime/scene/local_origin.h"
#include "runtime/scene/mesh_blas.h"
#include "runtime/scene/parts.h"
#include "runtime/scene/top_level.h"
#include "runtime/scene/wall_frame.h"

namespace nightcity::scene {
namespace {

constexpr std::uint32_t body_stack = BVH_STACK - 3 * VEHICLE_LEVELS - 2;

gpu::Instance make_instance(const glm::dmat4& to_object, std::uint32_t root, bool casts_shadow,
                            const Placement& at) {
  gpu::Instance instance{};
  for (int row = 0; row < 3; ++row)
    instance.to_object[row] = glm::vec4(
        glm::dvec4(to_object[0][row], to_object[1][row], to_object[2][row], to_object[3][row]));
  instance.root = root;
  instance.mask = MASK_VISIBLE | (casts_shadow ? MASK_SHADOW : 0u);
  instance.light = at.light;
  instance.feature = at.feature;
  return instance;
}

// Returns the box of another that is moved, in a frame.
Box transformed(const Box& box, const glm::dmat4& m, const hierarchy::BoxFrame& frame = {}) {
  Box out;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1) ? box.upper.x : box.lower.x,
                       (corner & 2) ? box.upper.y : box.lower.y,
                       (corner & 4) ? box.upper.z : box.lower.z, 1.0);
    out.grow(glm::vec3(frame.turn(glm::dvec3(m * p))));
  }
  // The corners were rounded to float: a margin of one part in a million keeps the content inside.
  const glm::vec3 margin =
      1e-6f * glm::max(glm::abs(out.lower), glm::abs(out.upper)) + 1e-6f + frame.margin_m;
  out.lower -= margin;
  out.upper += margin;
  return out;
}

// Asks for all memory at once, because growing an array holds it twice. What is asked for and not
// used takes no room: nodes are usually 0.4 for each triangle.
void reserve_memory(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                    const MeshPlacement& placement) {
  std::size_t most = out.triangles.size(), instances = 2;
  std::vector<bool> counted(meshes.triangles.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const SceneNode& node = scene.nodes[i];
    if (placement.is_skipped(i)) continue;
    if (placement.is_merged(i)) {
      most += meshes.triangles.at(node.mesh) * node.instances.size();
      continue;
    }
    instances += node.instances.size();
    if (!counted.at(node.mesh)) most += meshes.triangles.at(node.mesh);
    counted[node.mesh] = true;
  }
  most = std::min<std::size_t>(most, BVH_LEAF_FIRST_MASK);  // no scene may have more
  out.triangles.reserve(most);
  out.triangle_order.reserve(most + hierarchy::find_room(most));
  out.nodes.reserve(out.nodes.size() + most / 2);
  out.instances.reserve(instances);
}

// Returns the file's hierarchy of these nodes, null where it has none. Boxes are stored in the
// frame of model space.
const StoredHierarchy* find_stored(RenderScene& out, const std::vector<StoredHierarchy>& all,
                                   bool shadow, const std::vector<std::uint32_t>& nodes) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const StoredHierarchy& stored) {
    return stored.casts_shadow == shadow;
  });
  if (found == all.end() || out.origin != glm::dvec3(0)) return nullptr;
  if (found->nodes == nodes) return &*found;
  say_unused(out, "it is of other nodes");
  return nullptr;
}

// The triangles that stand where they are stored, and the file's hierarchy of them, or null.
struct MergedMeshes {
  TriangleRange range{};
  const StoredHierarchy* hierarchy = nullptr;
  VertexCheck vertices = VertexCheck::now;
};

// The triangles of a scene's meshes, as they are stored.
struct StoredMeshes {
  std::array<MergedMeshes, 2> merged;                   // those that cast shadows, and the others
  std::vector<std::optional<TriangleRange>> instanced;  // of each mesh
};

MergedMeshes store_merged(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                          const GeometryFilter& filter, MeshPlacement& placement, bool shadow,
                          VertexCheck vertices, unsigned threads) {
  std::vector<PlacedMesh> placed;
  std::vector<std::uint32_t> nodes;  // of the file
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (placement.is_skipped(i) || !placement.is_merged(i) || placement.casts_shadow(i) != shadow)
      continue;
    PlacedMesh one{scene.nodes[i].mesh, placement.find_placements(i)};
    if (one.placements.empty()) continue;
    triangles += meshes.triangles.at(one.mesh) * one.placements.size();
    placed.push_back(std::move(one));
    nodes.push_back(scene.nodes[i].number);
  }
  MergedMeshes merged;
  merged.hierarchy = find_stored(out, meshes.hierarchies, shadow, nodes);
  // One of fewer triangles was made where some were not shown, which have to be found first.
  if (merged.hierarchy && merged.hierarchy->triangles == triangles) merged.vertices = vertices;
  merged.range.first = out.triangles.size();
  out.dropped_triangles +=
      append_meshes(placed, meshes, filter.light_numbers, threads, out.triangles, merged.vertices);
  merged.range.end = out.triangles.size();
  return merged;
}

StoredMeshes store_triangles(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                             const GeometryFilter& filter, MeshPlacement& placement,
                             VertexCheck vertices, unsigned threads) {
  StoredMeshes stored;
  for (const bool shadow : {true, false})
    stored.merged[shadow ? 0 : 1] =
        store_merged(out, scene, meshes, filter, placement, shadow, vertices, threads);
  stored.instanced.resize(meshes.triangles.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const std::uint32_t mesh = scene.nodes[i].mesh;
    if (placement.is_skipped(i) || placement.is_merged(i) || stored.instanced.at(mesh)) continue;
    const glm::dmat4 to_unit = glm::scale(glm::dmat4(1), glm::dvec3(placement.unit(mesh)));
    const std::size_t first = out.triangles.size();
    out.dropped_triangles +=
        append_mesh(meshes, mesh, to_unit, filter.light_numbers, out.triangles);
    stored.instanced[mesh] = {first, out.triangles.size()};
  }
  return stored;
}

// The frame of the boxes of everything that does not move: the file's, or else that of the walls.
hierarchy::BoxFrame find_frame(const RenderScene& out, const Scene& scene, const MeshSource& meshes,
                               const StoredMeshes& stored, const MeshPlacement& placement) {
  hierarchy::BoxFrame frame;
  const auto& all = meshes.hierarchies;
  frame.along = out.origin == glm::dvec3(0) && !all.empty()
                    ? all.front().along
                    : find_wall_direction(out.triangles, stored.merged[0].range.first,
                                          stored.merged[0].range.end);
  if (!frame.is_turned()) return frame;
  // A ray is turned with errors of 2^-22 of the coordinates on its way, and may come from as far
  // away as four times the scene's size. One thing astray would make all boxes wide.
  constexpr double per_reach = 0x1p-19;
  const double reach = find_reach(scene, meshes, placement, out.origin);
  if (reach > max_reach_m) return {};
  frame.margin_m = static_cast<float>(per_reach * reach);
  return frame;
}

// Builds a BLAS for each mesh that is instanced, and two hierarchies for all others: a ray then
// crosses the city without leaving and entering instances. And the TLAS over all of them. Returns
// false where vertices that were to be looked at later must be looked at before.
bool add_hierarchies(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                     const StoredMeshes& stored, MeshPlacement& placement, unsigned threads) {
  const hierarchy::BoxFrame frame = find_frame(out, scene, meshes, stored, placement);
  out.boxes_along = frame.along;
  out.boxes_margin_m = frame.margin_m;
  std::vector<TopPart> inside, around;
  for (const bool shadow : {true, false}) {
    const MergedMeshes& merged = stored.merged[shadow ? 0 : 1];
    const auto added =
        add_static_blas(out, merged.range, merged.vertices, threads, merged.hierarchy, frame);
    if (!added) return false;
    if (added->node == BVH_EMPTY) continue;
    // Pipelines of the device know no triangles but those of instances.
    out.instances.push_back(make_instance(glm::dmat4(1), added->node, shadow, {glm::dmat4(1)}));
    inside.push_back({added->node, added->stack_need, out.instances.back(),
                      transformed(added->box, glm::dmat4(1), frame), true});
    out.bounds.grow(transformed(added->box, glm::dmat4(1)));
  }
  std::vector<std::optional<BvhRoot>> built(stored.instanced.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (placement.is_skipped(i) || placement.is_merged(i)) continue;
    auto& mesh = built.at(scene.nodes[i].mesh);
    if (!mesh) mesh = add_blas(out, *stored.instanced.at(scene.nodes[i].mesh), threads);
    if (mesh->node == BVH_EMPTY) continue;
    const bool shadow = placement.casts_shadow(i), is_around = is_horizon(scene.nodes[i]);
    for (const Placement& at : placement.find_placements(i)) {
      const Box box = transformed(mesh->box, at.to_scene);
      if (!is_within_reach(box.lower) || !is_within_reach(box.upper)) {
        ++out.dropped_instances;
        continue;
      }
      (is_around && !shadow ? around : inside)
          .push_back({mesh->node, mesh->stack_need,
                      make_instance(glm::inverse(at.to_scene), mesh->node, shadow, at),
                      transformed(mesh->box, at.to_scene, frame)});
      if (!is_around) out.bounds.grow(box);
    }
  }
  add_top_level(out, std::move(inside), threads);
  add_horizon(out, around, threads);
  return true;
}

// Appends a box of twelve triangles that face outwards.
void append_box(const glm::vec3& lower, const glm::vec3& upper, TriangleList& out) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto corner = [&](bool at_u, bool at_v) {
        glm::vec3 p;
        p[axis] = (far ? upper : lower)[axis];
        p[u] = (at_u ? upper : lower)[u];
        p[v] = (at_v ? upper : lower)[v];
        return p;
      };
      const glm::vec3 a = corner(false, false), b = corner(far, !far), c = corner(true, true),
                      d = corner(!far, far);
      out.push_back({a, 0, b, NO_HIT, c, NO_HIT});
      out.push_back({a, 0, c, NO_HIT, d, NO_HIT});
    }
}

}  // namespace

bool add_geometry(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                  const GeometryFilter& filter, VertexCheck vertices, unsigned threads) {
  MeshPlacement placement(scene, meshes, filter, out.origin, !out.traffic.trips.empty());
  reserve_memory(out, scene, meshes, placement);
  const StoredMeshes stored =
      store_triangles(out, scene, meshes, filter, placement, vertices, threads);
  if (meshes.close) meshes.close();
  if (!add_hierarchies(out, scene, meshes, stored, placement, threads)) return false;
  out.dropped_instances += placement.dropped();
  out.triangles.release_pages();
  return true;
}

void add_bodies(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                const PartSet& left_out) {
  for (std::uint32_t kind = 0; kind < out.traffic.vehicles.size(); ++kind) {
    const std::size_t first = out.triangles.size();
    std::uint32_t mask = MASK_VISIBLE;
    for (const SceneNode& node : scene.nodes) {
      if (node.vehicle != kind) continue;
      out.dropped_triangles += append_mesh(meshes, node.mesh, glm::dmat4(1.0), {}, out.triangles);
      if (node.casts_shadow) mask |= MASK_SHADOW;
    }
    if (out.triangles.size() == first) {
      const glm::vec3 size = out.traffic.vehicles[kind].half_size;
      append_box({-size.x, 0.0f, -size.z}, {size.x, 2 * size.y, size.z}, out.triangles);
      mask |= MASK_SHADOW;
    }
    if (holds(left_out, Part::vehicle_shadows)) mask = MASK_VISIBLE;
    const BvhRoot root = add_blas(out, {first, out.triangles.size()}, 1, body_stack);
    out.traffic.bodies.push_back({root.box.lower, root.node, root.box.upper, mask});
  }
}

}  // namespace nightcity::scene
