#include "runtime/scene/parts.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>

namespace nightcity::scene {
namespace {

constexpr glm::vec3 straight_down(0, -1, 0), east(1, 0, 0);

// A file without provenance does not name families: there, rectangles are windows.
bool is_window(const SceneLights& lights, std::size_t i) {
  return light_kind(lights.lights[i]) == LightKind::rectangle ||
         (i < lights.families.size() && lights.families[i] == LightFamily::window);
}

bool has_profile(const Light& light, const SceneLights& lights) {
  return light_profile(light) < lights.profiles.size();
}

bool is_sphere(const Light& light) {
  return light_kind(light) == LightKind::sphere;
}

// Returns whether it makes a difference where a lamp looks. A profile that is rotationally
// symmetric looks alike from all sides.
bool is_aimed(const Light& light, const SceneLights& lights) {
  if (!is_sphere(light) || !has_profile(light, lights)) return false;
  return light.axis != straight_down ||
         (lights.profiles[light_profile(light)].c_count > 1 && light.tangent != east);
}

void remove_profile(Light& light) {
  light.kind_profile =
      pack_kind_profile(static_cast<std::uint32_t>(light_kind(light)), LIGHT_NO_PROFILE);
}

std::array<std::span<Light>, 2> groups_of(SceneLights& lights) {
  return {lights.lights, lights.traffic.vehicle_lights};
}

template <class Values>
void keep(Values& values, const std::vector<bool>& kept) {
  if (values.size() != kept.size()) return;  // a list that is empty because nothing is known
  std::size_t to = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (kept[i]) values[to++] = values[i];
  values.resize(to);
}

// Removes windows, and returns the new number of each light.
std::vector<std::uint32_t> remove_windows(SceneLights& lights) {
  std::vector<std::uint32_t> numbers;
  std::vector<bool> kept;
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    kept.push_back(!is_window(lights, i));
    numbers.push_back(kept.back() ? next++ : left_out_light);
  }
  keep(lights.lights, kept);
  keep(lights.families, kept);
  keep(lights.provenance, kept);
  return numbers;
}

// Makes lamps points, and unlinks the surfaces that shine as they did: the luminance of a point has
// no bound.
void remove_sizes(SceneLights& lights, std::vector<std::uint32_t>& numbers) {
  if (numbers.empty())
    for (std::uint32_t i = 0; i < lights.lights.size(); ++i) numbers.push_back(i);
  for (std::uint32_t& number : numbers)
    if (number < lights.lights.size() && is_sphere(lights.lights[number])) number = unlinked_light;
  for (const std::span<Light> group : groups_of(lights))
    for (Light& light : group)
      if (is_sphere(light)) light.radius = 0;
}

std::size_t count_instances(const SceneNode& node) {
  return node.instances.size();
}

}  // namespace

PartCounts count_parts(const SceneLights& lights, const Scene& scene) {
  PartCounts counts{};
  const auto count = [&counts](Part part, std::size_t more) {
    counts[static_cast<std::size_t>(part)] += more;
  };
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const Light& light = lights.lights[i];
    count(Part::windows, is_window(lights, i));
    count(Part::profiles, is_sphere(light) && has_profile(light, lights));
    count(Part::aim, is_aimed(light, lights));
    count(Part::lamp_sizes, is_sphere(light) && light.radius > 0);
    count(Part::schedules, light.schedule != LIGHT_ALWAYS_ON);
  }
  count(Part::traffic, lights.traffic.trips.size());
  if (!lights.traffic.trips.empty())
    for (const Light& light : lights.traffic.vehicle_lights)
      count(Part::profiles, has_profile(light, lights));
  for (const SceneNode& node : scene.nodes) {
    if (node.kind == "lamp") count(Part::lamp_bodies, count_instances(node));
    if (node.kind == "tree") count(Part::trees, count_instances(node));
    if (node.vehicle == no_id) continue;
    if (lights.traffic.trips.empty()) count(Part::traffic, count_instances(node));
    if (node.casts_shadow && (!lights.traffic.trips.empty() || !node.instances.empty()))
      count(Part::vehicle_shadows, 1);
  }
  // A kind of vehicle without a mesh is a box, which casts a shadow (add_bodies).
  if (!lights.traffic.trips.empty())
    for (std::uint32_t kind = 0; kind < lights.traffic.vehicles.size(); ++kind)
      count(Part::vehicle_shadows,
            std::none_of(scene.nodes.begin(), scene.nodes.end(),
                         [kind](const SceneNode& node) { return node.vehicle == kind; }));
  return counts;
}

void count_materials(const RenderScene& scene, PartCounts& counts) {
  for (const gpu::Material& material : scene.materials) {
    counts[static_cast<std::size_t>(Part::colours)] +=
        material.base_colour != scene.materials.front().base_colour;
    counts[static_cast<std::size_t>(Part::water)] += material.roughness < WATER_ROUGHNESS;
  }
}

std::vector<std::uint32_t> leave_out_lights(SceneLights& lights, const PartSet& left_out) {
  std::vector<std::uint32_t> numbers;
  if (holds(left_out, Part::windows)) numbers = remove_windows(lights);
  if (holds(left_out, Part::traffic)) lights.traffic = {};
  if (holds(left_out, Part::aim))
    for (Light& light : lights.lights)
      if (is_aimed(light, lights)) {
        light.axis = straight_down;
        light.tangent = east;
      }
  if (holds(left_out, Part::profiles)) {
    for (const std::span<Light> group : groups_of(lights))
      for (Light& light : group)
        if (has_profile(light, lights)) remove_profile(light);
    lights.profiles.clear();
    lights.profile_data.clear();
  }
  if (holds(left_out, Part::lamp_sizes)) remove_sizes(lights, numbers);
  if (holds(left_out, Part::schedules)) {
    for (Light& light : lights.lights) light.schedule = LIGHT_ALWAYS_ON;
    lights.schedules.clear();
    lights.switches.clear();
  }
  return numbers;
}

bool is_left_out(const SceneNode& node, const PartSet& left_out) {
  return (node.kind == "window" && holds(left_out, Part::windows)) ||
         (node.kind == "lamp" && holds(left_out, Part::lamp_bodies)) ||
         (node.kind == "tree" && holds(left_out, Part::trees)) ||
         (node.vehicle != no_id && holds(left_out, Part::traffic));
}

void leave_out_of_materials(RenderScene& scene, const PartSet& left_out) {
  if (holds(left_out, Part::colours)) {
    glm::dvec3 sum(0);
    double areas = 0;
    for (const gpu::Triangle& t : scene.triangles) {
      if (t.material >= scene.materials.size()) continue;
      const double area =
          0.5 * glm::length(glm::cross(glm::dvec3(t.v1 - t.v0), glm::dvec3(t.v2 - t.v0)));
      sum += area * glm::dvec3(scene.materials[t.material].base_colour);
      areas += area;
    }
    if (areas > 0)
      for (gpu::Material& material : scene.materials) material.base_colour = sum / areas;
  }
  if (holds(left_out, Part::water))
    for (gpu::Material& material : scene.materials)
      if (material.roughness < WATER_ROUGHNESS) material.roughness = 1;
}

}  // namespace nightcity::scene
