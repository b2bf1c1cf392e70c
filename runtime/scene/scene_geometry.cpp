#include "runtime/scene/scene_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <span>
#include <utility>

#include "runtime/scene/mesh_triangles.h"
#include "runtime/scene/parts.h"

namespace nightcity::scene {
namespace {

constexpr std::uint32_t triangle_leaf = 4;
// A ray may defer BVH_STACK entries. This is how the TLAS and the BLASes share them.
constexpr std::uint32_t tlas_stack = 33;
// One entry is for the other child of the root above the static scene and the vehicles.
constexpr std::uint32_t mesh_stack = BVH_STACK - tlas_stack - 1;
constexpr std::uint32_t body_stack = BVH_STACK - 3 * VEHICLE_LEVELS - 2;

// Consecutive triangles of a scene, from `first` to before `end`.
struct TriangleRange {
  std::size_t first, end;
};

// Builds the BLAS over some triangles, and returns its root and box.
std::pair<std::uint32_t, Box> add_blas(RenderScene& scene, const TriangleRange& range,
                                       unsigned threads, std::uint32_t stack = mesh_stack) {
  const std::size_t count = range.end - range.first;
  scene.triangle_order.resize(range.end);
  const BvhRoot root = append_bvh(scene.nodes, scene.triangles, range.first, triangle_leaf, stack,
                                  threads, std::span(scene.triangle_order).subspan(range.first));
  if (count > 0)
    scene.meshes.push_back(
        {root.node, static_cast<std::uint32_t>(range.first), static_cast<std::uint32_t>(count)});
  return {root.node, root.box};
}

gpu::Instance make_instance(const glm::dmat4& to_object, std::uint32_t root, bool casts_shadow,
                            std::uint32_t light) {
  gpu::Instance instance{};
  for (int row = 0; row < 3; ++row)
    instance.to_object[row] = glm::vec4(
        glm::dvec4(to_object[0][row], to_object[1][row], to_object[2][row], to_object[3][row]));
  instance.root = root;
  instance.mask = MASK_VISIBLE | (casts_shadow ? MASK_SHADOW : 0u);
  instance.light = light;
  instance.feature = NO_HIT;
  return instance;
}

Box transformed(const Box& box, const glm::dmat4& m) {
  Box out;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1) ? box.upper.x : box.lower.x,
                       (corner & 2) ? box.upper.y : box.lower.y,
                       (corner & 4) ? box.upper.z : box.lower.z, 1.0);
    out.grow(glm::vec3(m * p));
  }
  // The corners were rounded to float: a margin of one part in a million keeps the content inside.
  const glm::vec3 margin = 1e-6f * glm::max(glm::abs(out.lower), glm::abs(out.upper)) + 1e-6f;
  out.lower -= margin;
  out.upper += margin;
  return out;
}

// Returns, for each mesh, the power of two by which the triangles of its instances are multiplied
// where they are stored: near the scale of its largest instance, so that areas and the determinants
// of ray tests stay within a float in whatever unit the mesh is. It is 1 for usual scales, whose
// triangles can be read in place.
std::vector<double> find_units(const Scene& scene, std::size_t meshes) {
  constexpr double usual = 1024;
  std::vector<double> units(meshes, 0.0);
  for (const SceneNode& node : scene.nodes)
    for (const SceneInstance& instance : node.instances)
      for (int axis = 0; axis < 3; ++axis)
        units.at(node.mesh) = std::max(
            units.at(node.mesh), glm::length(glm::dvec3(glm::dmat4(instance.to_model)[axis])));
  for (double& unit : units) {
    const bool is_usual = unit >= 1 / usual && unit <= usual;
    unit = is_usual || !(unit > 0) || !std::isfinite(unit) ? 1
                                                           : std::exp2(std::round(std::log2(unit)));
  }
  return units;
}

glm::dmat4 scaled(double factor) {
  return glm::scale(glm::dmat4(1.0), glm::dvec3(factor));
}

// Builds the TLAS over the instances, and puts them in its order.
void add_tlas(RenderScene& out, const std::vector<Box>& instance_boxes, unsigned threads) {
  std::vector<std::uint8_t> masks;
  masks.reserve(out.instances.size());
  for (const gpu::Instance& instance : out.instances)
    masks.push_back(static_cast<std::uint8_t>(instance.mask));
  Bvh top = build_bvh(instance_boxes, 1, tlas_stack, masks, threads);
  std::vector<gpu::Instance> ordered;
  ordered.reserve(top.order.size());
  for (const std::uint32_t i : top.order) ordered.push_back(out.instances[i]);
  out.instances = std::move(ordered);
  rebase(top, static_cast<std::uint32_t>(out.nodes.size()), 0);
  out.root = top.root;
  out.nodes.insert(out.nodes.end(), top.nodes.begin(), top.nodes.end());
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

void add_geometry(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                  const GeometryFilter& filter, unsigned threads) {
  std::vector<Box> instance_boxes;
  const auto to_scene = [&](const SceneInstance& instance) {
    glm::dmat4 matrix = to_double(instance);
    matrix[3] -= glm::dvec4(out.origin, 0);
    return matrix;
  };
  const auto place = [&](std::uint32_t root, const Box& box, const glm::dmat4& placed, bool shadow,
                         std::uint32_t light) {
    const double determinant = glm::determinant(glm::dmat3(placed));
    if (root == BVH_EMPTY) return;
    if (!std::isfinite(determinant) || std::abs(determinant) < 1e-18) {
      ++out.dropped_instances;
      return;
    }
    instance_boxes.push_back(transformed(box, placed));
    out.instances.push_back(make_instance(glm::inverse(placed), root, shadow, light));
    out.bounds.grow(instance_boxes.back());
  };

  // The file's vehicles show one moment. Where there is traffic, it replaces them.
  const auto is_skipped = [&](const SceneNode& node) {
    return is_left_out(node, filter.left_out) ||
           (!out.traffic.trips.empty() && node.vehicle != no_id);
  };
  const auto casts_shadow = [&](const SceneNode& node) {
    return node.casts_shadow &&
           !(node.vehicle != no_id && holds(filter.left_out, Part::vehicle_shadows));
  };
  const auto is_merged = [](const SceneNode& node) {
    return node.instances.size() == 1 && node.instances[0].light == no_id;
  };

  // All memory is asked for at once, because growing an array holds it twice. What is asked for and
  // not used takes no room: nodes are usually 0.4 for each triangle.
  std::size_t most = out.triangles.size();
  std::vector<bool> counted(meshes.triangles.size());
  for (const SceneNode& node : scene.nodes)
    if (!is_skipped(node) && (is_merged(node) || !counted.at(node.mesh))) {
      most += meshes.triangles.at(node.mesh);
      if (!is_merged(node)) counted[node.mesh] = true;
    }
  most = std::min<std::size_t>(most, BVH_LEAF_FIRST_MASK);  // no scene may have more
  out.triangles.reserve(most);
  out.triangle_order.reserve(most);
  out.nodes.reserve(out.nodes.size() + most / 2);

  // Everything that is placed once and does not move becomes one BLAS (one for what casts shadows,
  // one for what does not): a ray then crosses the city without leaving and entering instances. All
  // meshes are read before the first BLAS is built, because their source takes memory, too.
  std::array<TriangleRange, 2> still;
  for (const bool shadow : {true, false}) {
    std::vector<PlacedMesh> merged;
    for (const SceneNode& node : scene.nodes)
      if (!is_skipped(node) && is_merged(node) && casts_shadow(node) == shadow)
        merged.push_back({node.mesh, to_scene(node.instances[0])});
    const std::size_t first = out.triangles.size();
    out.dropped_triangles +=
        append_meshes(merged, meshes, filter.light_numbers, threads, out.triangles);
    still[shadow ? 0 : 1] = {first, out.triangles.size()};
  }
  const std::vector<double> units = find_units(scene, meshes.triangles.size());
  std::vector<std::optional<TriangleRange>> placed(meshes.triangles.size());
  for (const SceneNode& node : scene.nodes) {
    if (is_skipped(node) || is_merged(node) || placed.at(node.mesh)) continue;
    const std::size_t first = out.triangles.size();
    out.dropped_triangles += append_mesh(meshes, node.mesh, scaled(units[node.mesh]),
                                         filter.light_numbers, out.triangles);
    placed[node.mesh] = {first, out.triangles.size()};
  }
  if (meshes.close) meshes.close();

  std::size_t instances = still.size();
  for (const SceneNode& node : scene.nodes) instances += node.instances.size();
  out.instances.reserve(instances);
  instance_boxes.reserve(instances);
  for (const bool shadow : {true, false}) {
    const auto [root, box] = add_blas(out, still[shadow ? 0 : 1], threads);
    place(root, box, glm::dmat4(1.0), shadow, NO_HIT);
  }
  std::vector<std::optional<std::pair<std::uint32_t, Box>>> built(meshes.triangles.size());
  for (const SceneNode& node : scene.nodes) {
    if (is_skipped(node) || is_merged(node)) continue;
    auto& mesh = built.at(node.mesh);
    if (!mesh) mesh = add_blas(out, *placed.at(node.mesh), threads);
    for (const SceneInstance& instance : node.instances) {
      const std::uint32_t light = find_light(instance.light, filter.light_numbers);
      if (light != left_out_light)
        place(mesh->first, mesh->second, to_scene(instance) * scaled(1 / units[node.mesh]),
              casts_shadow(node), light);
    }
  }
  out.triangles.release_pages();
  add_tlas(out, instance_boxes, threads);
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
    const auto [root, box] = add_blas(out, {first, out.triangles.size()}, 1, body_stack);
    out.traffic.bodies.push_back({box.lower, root, box.upper, mask});
  }
}

}  // namespace nightcity::scene
