#include "runtime/scene/render_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "formats/error.h"
#include "formats/night_check.h"
#include "formats/scene_reader.h"

namespace nightcity {
namespace {

constexpr std::uint32_t triangle_leaf = 4;
// Of the BVH_STACK entries a ray has: the top level's share and the meshes'.
constexpr std::uint32_t top_level_stack = 33;
// One entry is the other child of the root that the standing scene and the fleet share.
constexpr std::uint32_t mesh_stack = BVH_STACK - top_level_stack - 1;
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
      t.material = primitive.material;
      t.feature = primitive.feature_ids.empty() ? NO_HIT : primitive.feature_ids[a];
      t.light = primitive.light_ids.empty() ? NO_HIT : primitive.light_ids[a];
      out.push_back(t);
    }
  }
}

// Appends a mesh's triangles, ordered by its hierarchy, and the hierarchy; returns the root and the mesh's
// box.
std::pair<std::uint32_t, Box> add_hierarchy(RenderScene& scene,
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
  // The corners were rounded to float: one part in a million keeps the box around what it holds.
  const glm::vec3 margin = 1e-6f * glm::max(glm::abs(out.lower), glm::abs(out.upper)) + 1e-6f;
  out.lower -= margin;
  out.upper += margin;
  return out;
}

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

  // Where there is traffic, the vehicles of the file, which show one moment, make way for it.
  const auto is_vehicle = [&](const SceneNode& node) {
    return !out.traffic.trips.empty() && node.vehicle != no_id;
  };

  // Whatever stands once becomes one static hierarchy (one for what casts shadows, one for what does not): a
  // ray then crosses the city without leaving and entering instances.
  for (const bool shadow : {true, false}) {
    std::vector<gpu::Triangle> triangles;
    for (const SceneNode& node : scene.nodes)
      if (!is_vehicle(node) && node.instances.size() == 1 && node.instances[0].light == no_id &&
          node.casts_shadow == shadow)
        append_mesh(scene.meshes[node.mesh], node.instances[0].to_model, triangles,
                    out.dropped_triangles);
    const auto [root, box] = add_hierarchy(out, triangles);
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
      mesh = add_hierarchy(out, triangles);
    }
    for (const SceneInstance& instance : node.instances)
      place(mesh->first, mesh->second, glm::dmat4(instance.to_model), node.casts_shadow,
            instance.light);
  }

  std::vector<std::uint8_t> masks;
  masks.reserve(out.instances.size());
  for (const gpu::Instance& instance : out.instances)
    masks.push_back(static_cast<std::uint8_t>(instance.mask));
  Bvh top = build_bvh(instance_boxes, 1, top_level_stack, masks);
  std::vector<gpu::Instance> ordered;
  ordered.reserve(top.order.size());
  for (const std::uint32_t i : top.order) ordered.push_back(out.instances[i]);
  out.instances = std::move(ordered);
  rebase(top, static_cast<std::uint32_t>(out.nodes.size()), 0);
  out.root = top.root;
  out.nodes.insert(out.nodes.end(), top.nodes.begin(), top.nodes.end());
}

// Twelve triangles, outwards.
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

// A body for each kind of vehicle: the scene's mesh, or a plain box where it has none.
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
    const auto [root, box] = add_hierarchy(out, triangles, body_stack);
    out.traffic.bodies.push_back({box.lower, root, box.upper, mask});
  }
}

// Trips, vehicles and their lights go to the device as they are, so whatever is unfit goes no further.
void check_traffic(const Traffic& traffic, std::size_t profiles) {
  if (traffic.trips.empty()) return;
  const auto refuse = [](const std::string& what, std::size_t i,
                         const std::optional<std::string>& fault) {
    if (fault) throw Error("traffic", what + " " + std::to_string(i), *fault);
  };
  refuse("cycle", 0, cycle_fault(traffic.cycle));
  for (std::size_t i = 0; i < traffic.vehicles.size(); ++i)
    refuse("vehicle", i, vehicle_fault(traffic.vehicles[i], traffic.vehicle_lights.size()));
  for (std::size_t i = 0; i < traffic.vehicle_lights.size(); ++i)
    refuse("vehicle light", i, vehicle_light_fault(traffic.vehicle_lights[i], profiles));
  for (std::size_t i = 0; i < traffic.trips.size(); ++i)
    refuse("trip", i,
           trip_fault(traffic.trips[i], traffic.cycle, traffic.vehicles.size(), traffic.knots));
}

bool usable(const Light& light, std::size_t profiles) {
  for (const glm::vec3& v : {light.position, light.axis, light.tangent})
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  const std::uint32_t profile = light.kind_profile >> 8;
  return std::isfinite(light.radius) && std::isfinite(light.half_height) &&
         std::isfinite(light.flux_lm) && light.flux_lm > 0 &&
         (profile == LIGHT_NO_PROFILE || profile < profiles);
}

}  // namespace

RenderScene make_render_scene(const Scene& scene, SceneLights lights) {
  RenderScene out;
  for (const SceneMaterial& m : scene.materials)
    out.materials.push_back({m.base_colour, m.roughness, m.emission_cd_m2, 0});
  if (out.materials.empty()) out.materials.push_back({glm::vec3(0.5f), 1.0f, glm::vec3(0.0f), 0});
  out.profiles = std::move(lights.profiles);
  out.profile_data = std::move(lights.profile_data);
  out.traffic = std::move(lights.traffic);
  check_traffic(out.traffic, out.profiles.size());
  add_bodies(out, scene);
  add_geometry(out, scene);

  out.lights = std::move(lights.lights);
  out.families = std::move(lights.families);
  out.families.resize(out.lights.size(), LightFamily::other);
  out.schedules = std::move(lights.schedules);
  out.switches = std::move(lights.switches);
  for (std::size_t i = 0; i < out.schedules.size(); ++i)
    if (const auto fault = schedule_fault(out.schedules[i], out.switches))
      throw Error("schedule " + std::to_string(i), *fault);
  for (Light& light : out.lights) {
    if (usable(light, out.profiles.size())) continue;
    // Its index stays, since geometry refers to it; it just never shines.
    ++out.bad_lights;
    const std::uint32_t id = light.id;
    light = Light{};
    light.axis = {0, -1, 0};
    light.tangent = {1, 0, 0};
    light.kind_profile = LIGHT_SPHERE | LIGHT_NO_PROFILE << 8;
    light.schedule = LIGHT_ALWAYS_ON;
    light.id = id;
  }
  return out;
}

RenderScene load_render_scene(const std::filesystem::path& glb) {
  const Scene scene = read_scene(glb);
  SceneLights lights;
  std::filesystem::path beside = glb;
  beside.replace_extension(".lights");
  if (std::filesystem::exists(beside)) {
    const LightFile file = LightFile::open(beside);
    lights.lights.assign(file.lights().begin(), file.lights().end());
    for (const LightProvenance& p : file.provenance())
      lights.families.push_back(static_cast<LightFamily>(p.family));
    lights.profiles.assign(file.profiles().begin(), file.profiles().end());
    lights.profile_data.assign(file.profile_data().begin(), file.profile_data().end());
    lights.schedules.assign(file.schedules().begin(), file.schedules().end());
    lights.switches.assign(file.switches().begin(), file.switches().end());
    const TrafficContent traffic = file.traffic();
    lights.traffic.cycle = traffic.cycle;
    lights.traffic.vehicles.assign(traffic.vehicles.begin(), traffic.vehicles.end());
    lights.traffic.vehicle_lights.assign(traffic.vehicle_lights.begin(),
                                         traffic.vehicle_lights.end());
    lights.traffic.trips.assign(traffic.trips.begin(), traffic.trips.end());
    lights.traffic.knots.assign(traffic.knots.begin(), traffic.knots.end());
  }
  return make_render_scene(scene, std::move(lights));
}

std::optional<double> brute_force_hit(const RenderScene& scene, const glm::dvec3& origin,
                                      const glm::dvec3& direction, double t_max,
                                      std::uint32_t mask) {
  double nearest = t_max;
  bool found = false;
  const auto test = [&](const gpu::Triangle& triangle, const glm::dvec3& o, const glm::dvec3& d) {
    const glm::dvec3 v0(triangle.v0), e1 = glm::dvec3(triangle.v1) - v0,
                                      e2 = glm::dvec3(triangle.v2) - v0;
    const glm::dvec3 p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) return;
    const glm::dvec3 s = o - v0;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(d, q) / determinant;
    const double t = glm::dot(e2, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) {
      nearest = t;
      found = true;
    }
  };
  for (const gpu::Instance& instance : scene.instances) {
    if (!(instance.mask & mask)) continue;
    const auto row = [&](int i, const glm::dvec3& v, double w) {
      return glm::dot(glm::dvec4(instance.to_object[i]), glm::dvec4(v, w));
    };
    const glm::dvec3 o(row(0, origin, 1), row(1, origin, 1), row(2, origin, 1));
    const glm::dvec3 d(row(0, direction, 0), row(1, direction, 0), row(2, direction, 0));
    // Every triangle below the instance's root, whatever the boxes say.
    std::vector<std::uint32_t> pending{instance.root};
    while (!pending.empty()) {
      const std::uint32_t node = pending.back();
      pending.pop_back();
      if (node == BVH_EMPTY) continue;
      if (node & BVH_LEAF) {
        const std::uint32_t first = node & BVH_LEAF_FIRST_MASK;
        const std::uint32_t count = ((node & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
        for (std::uint32_t i = first; i < first + count; ++i) test(scene.triangles[i], o, d);
      } else {
        for (const std::uint32_t child : scene.nodes[node].child) pending.push_back(child);
      }
    }
  }
  if (!found) return std::nullopt;
  return nearest;
}

}  // namespace nightcity
