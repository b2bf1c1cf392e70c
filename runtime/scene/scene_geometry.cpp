#include "runtime/scene/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "formats/error.h"

namespace nightcity::scene {
namespace {

constexpr std::uint32_t triangle_leaf = 4;
// A ray may defer BVH_STACK entries. This is how the TLAS and the BLASes share them.
constexpr std::uint32_t tlas_stack = 33;
// One entry is for the other child of the root above the static scene and the vehicles.
constexpr std::uint32_t mesh_stack = BVH_STACK - tlas_stack - 1;
constexpr std::uint32_t body_stack = BVH_STACK - 3 * VEHICLE_LEVELS - 2;

Box box_of(const gpu::Triangle& t) {
  Box box;
  box.grow(t.v0);
  box.grow(t.v1);
  box.grow(t.v2);
  return box;
}

void append_mesh(const SceneMesh& mesh, const glm::mat4& to_model, std::vector<gpu::Triangle>& out,
                 std::size_t& dropped) {
  const glm::dmat4 m(to_model);
  for (const ScenePrimitive& primitive : mesh.primitives) {
    std::vector<glm::vec3> positions;
    positions.reserve(primitive.positions.size());
    for (const glm::vec3& p : primitive.positions) positions.emplace_back(m * glm::dvec4(p, 1.0));
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const std::uint32_t a = primitive.indices[i], b = primitive.indices[i + 1],
                          c = primitive.indices[i + 2];
      gpu::Triangle t{};
      t.v0 = positions[a];
      t.v1 = positions[b];
      t.v2 = positions[c];
      const glm::vec3 normal = glm::cross(t.v1 - t.v0, t.v2 - t.v0);
      if (!(glm::dot(normal, normal) > 0)) {
        ++dropped;
        continue;
      }
      t.material = primitive.triangle_materials.empty() ? primitive.material
                                                        : primitive.triangle_materials[i / 3];
      t.feature = primitive.feature_ids.empty() ? NO_HIT : primitive.feature_ids[a];
      t.light = primitive.light_ids.empty() ? NO_HIT : primitive.light_ids[a];
      out.push_back(t);
    }
  }
}

// Builds a mesh's BLAS and appends it, with the triangles in its order; returns the root and the
// mesh's box.
std::pair<std::uint32_t, Box> add_blas(RenderScene& scene,
                                       const std::vector<gpu::Triangle>& triangles,
                                       std::uint32_t stack = mesh_stack) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  Box all;
  for (const gpu::Triangle& t : triangles) {
    boxes.push_back(box_of(t));
    all.grow(boxes.back());
  }
  Bvh bvh = build_bvh(boxes, triangle_leaf, stack);
  if (scene.triangles.size() + triangles.size() > BVH_LEAF_FIRST_MASK)
    throw Error("", "more than 134 million triangles in one scene");
  rebase(bvh, static_cast<std::uint32_t>(scene.nodes.size()),
         static_cast<std::uint32_t>(scene.triangles.size()));
  if (!triangles.empty())
    scene.meshes.push_back({bvh.root, static_cast<std::uint32_t>(scene.triangles.size()),
                            static_cast<std::uint32_t>(triangles.size())});
  for (const std::uint32_t i : bvh.order) scene.triangles.push_back(triangles[i]);
  scene.nodes.insert(scene.nodes.end(), bvh.nodes.begin(), bvh.nodes.end());
  return {bvh.root, all};
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

// Builds the TLAS over the instances, and puts them in its order.
void add_tlas(RenderScene& out, const std::vector<Box>& instance_boxes) {
  std::vector<std::uint8_t> masks;
  masks.reserve(out.instances.size());
  for (const gpu::Instance& instance : out.instances)
    masks.push_back(static_cast<std::uint8_t>(instance.mask));
  Bvh top = build_bvh(instance_boxes, 1, tlas_stack, masks);
  std::vector<gpu::Instance> ordered;
  ordered.reserve(top.order.size());
  for (const std::uint32_t i : top.order) ordered.push_back(out.instances[i]);
  out.instances = std::move(ordered);
  rebase(top, static_cast<std::uint32_t>(out.nodes.size()), 0);
  out.root = top.root;
  out.nodes.insert(out.nodes.end(), top.nodes.begin(), top.nodes.end());
}

// Returns a box of twelve triangles that face outwards.
std::vector<gpu::Triangle> box_mesh(const glm::vec3& lower, const glm::vec3& upper) {
  std::vector<gpu::Triangle> triangles;
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
      triangles.push_back({a, 0, b, NO_HIT, c, NO_HIT});
      triangles.push_back({a, 0, c, NO_HIT, d, NO_HIT});
    }
  return triangles;
}

}  // namespace

void add_geometry(RenderScene& out, const Scene& scene) {
  std::vector<Box> instance_boxes;
  const auto place = [&](std::uint32_t root, const Box& box, const glm::dmat4& to_model,
                         bool shadow, std::uint32_t light) {
    const double determinant = glm::determinant(glm::dmat3(to_model));
    if (root == BVH_EMPTY) return;
    if (!std::isfinite(determinant) || std::abs(determinant) < 1e-18) {
      ++out.dropped_instances;
      return;
    }
    instance_boxes.push_back(transformed(box, to_model));
    out.instances.push_back(make_instance(glm::inverse(to_model), root, shadow, light));
    out.bounds.grow(instance_boxes.back());
  };

  // The file's vehicles show one moment. Where there is traffic, it replaces them.
  const auto is_vehicle = [&](const SceneNode& node) {
    return !out.traffic.trips.empty() && node.vehicle != no_id;
  };

  // Everything that is placed once and does not move becomes one BLAS (one for what casts shadows,
  // one for what does not): a ray then crosses the city without leaving and entering instances.
  for (const bool shadow : {true, false}) {
    std::vector<gpu::Triangle> triangles;
    for (const SceneNode& node : scene.nodes)
      if (!is_vehicle(node) && node.instances.size() == 1 && node.instances[0].light == no_id &&
          node.casts_shadow == shadow)
        append_mesh(scene.meshes[node.mesh], node.instances[0].to_model, triangles,
                    out.dropped_triangles);
    const auto [root, box] = add_blas(out, triangles);
    place(root, box, glm::dmat4(1.0), shadow, NO_HIT);
  }
  std::vector<std::optional<std::pair<std::uint32_t, Box>>> built(scene.meshes.size());
  for (const SceneNode& node : scene.nodes) {
    if (is_vehicle(node) || (node.instances.size() == 1 && node.instances[0].light == no_id))
      continue;
    auto& mesh = built[node.mesh];
    if (!mesh) {
      std::vector<gpu::Triangle> triangles;
      append_mesh(scene.meshes[node.mesh], glm::mat4(1.0f), triangles, out.dropped_triangles);
      mesh = add_blas(out, triangles);
    }
    for (const SceneInstance& instance : node.instances)
      place(mesh->first, mesh->second, glm::dmat4(instance.to_model), node.casts_shadow,
            instance.light);
  }
  add_tlas(out, instance_boxes);
}

void add_bodies(RenderScene& out, const Scene& scene) {
  for (std::uint32_t kind = 0; kind < out.traffic.vehicles.size(); ++kind) {
    std::vector<gpu::Triangle> triangles;
    std::uint32_t mask = MASK_VISIBLE;
    for (const SceneNode& node : scene.nodes) {
      if (node.vehicle != kind) continue;
      append_mesh(scene.meshes[node.mesh], glm::mat4(1.0f), triangles, out.dropped_triangles);
      if (node.casts_shadow) mask |= MASK_SHADOW;
    }
    if (triangles.empty()) {
      const glm::vec3 size = out.traffic.vehicles[kind].half_size;
      triangles = box_mesh({-size.x, 0.0f, -size.z}, {size.x, 2 * size.y, size.z});
      mask |= MASK_SHADOW;
    }
    const auto [root, box] = add_blas(out, triangles, body_stack);
    out.traffic.bodies.push_back({box.lower, root, box.upper, mask});
  }
}

}  // namespace nightcity::scene
