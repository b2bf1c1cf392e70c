#include "runtime/experiments/lamp_field.h"

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "formats/rgb9e5.h"

namespace nightcity::experiments {
namespace {

constexpr float block_m = 80;
constexpr int lamps_a_side = 3, lamps_a_block = 2 * lamps_a_side;

void append_quad(ScenePrimitive& out, const std::array<glm::vec3, 4>& corners) {
  const auto base = static_cast<std::uint32_t>(out.positions.size());
  out.positions.insert(out.positions.end(), corners.begin(), corners.end());
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) out.indices.push_back(base + i);
}

// Walls and roof.
void append_house(ScenePrimitive& out, const glm::vec3& lo, const glm::vec3& hi) {
  const glm::vec3 a(lo.x, lo.y, hi.z), b(hi.x, lo.y, hi.z), c(hi.x, lo.y, lo.z),
      d(lo.x, lo.y, lo.z);
  const auto up = [&](const glm::vec3& p) { return glm::vec3(p.x, hi.y, p.z); };
  for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}, std::pair{d, a}})
    append_quad(out, {p, q, up(q), up(p)});
  append_quad(out, {up(a), up(b), up(c), up(d)});
}

Light street_lamp(const glm::vec3& position, float flux_lm) {
  Light light{};
  light.position = position;
  light.radius = 0.1f;
  light.axis = {0, -1, 0};
  light.tangent = {1, 0, 0};
  light.flux_lm = flux_lm;
  light.colour_rgb9e5 = encode_rgb9e5({1, 1, 1});
  light.kind_profile = pack_kind_profile(LightKind::sphere, LIGHT_NO_PROFILE);
  light.schedule = LIGHT_ALWAYS_ON;
  return light;
}

Light vehicle_lamp(const glm::vec3& position, const glm::vec3& axis, float flux_lm,
                   LightFamily family) {
  Light light = street_lamp(position, flux_lm);
  light.radius = 0.06f;
  light.axis = axis;
  light.tangent = {0, 1, 0};
  light.schedule = VEHICLE_LIGHT_ALWAYS;
  light.id = static_cast<std::uint32_t>(family);
  return light;
}

// Adds vehicles of one kind that drive along the streets in z, on the right.
void add_vehicles(scene::SceneLights& lights, std::size_t vehicles, int streets, float half,
                  const std::function<float(float, float)>& uniform) {
  scene::Traffic& traffic = lights.traffic;
  traffic.cycle.cycle_s = 100;
  for (float& share : traffic.cycle.density) share = 1;
  // The cosine to the tenth power within 40 degrees of the axis, in cd per lumen.
  constexpr std::uint32_t rows = 41;
  lights.profiles = {{1, rows, 0, 40}};
  double flux = 0;
  for (std::uint32_t i = 0; i < rows; ++i) {
    const double angle = i * std::numbers::pi / 180, value = std::pow(std::cos(angle), 10);
    lights.profile_data.push_back(float(value));
    flux += value * 2 * std::numbers::pi * std::sin(angle) * std::numbers::pi / 180;
  }
  for (float& value : lights.profile_data) value /= float(flux);
  for (const float side : {-0.6f, 0.6f}) {
    Light head = vehicle_lamp({2.1f, 0.7f, side}, {1, -0.02f, 0}, 460, LightFamily::headlamp);
    head.axis = glm::normalize(head.axis);
    head.tangent = glm::normalize(glm::vec3(0.02f, 1, 0));
    head.kind_profile = pack_kind_profile(LightKind::sphere, 0);
    traffic.vehicle_lights.push_back(head);
    traffic.vehicle_lights.push_back(
        vehicle_lamp({-2.1f, 0.8f, side}, {-1, 0, 0}, 25, LightFamily::tail_lamp));
  }
  traffic.vehicles = {
      {{2, 0.75f, 0.9f}, 0, static_cast<std::uint32_t>(traffic.vehicle_lights.size()), {}}};
  constexpr float trip_s = 99;
  const float length = std::min(8 * trip_s, 2 * half), speed = length / trip_s;
  for (std::size_t i = 0; i < vehicles; ++i) {
    const bool south = i % 2 == 0;  // +z
    const float street = std::floor(uniform(0, float(streets))),
                from = uniform(-half, half - length);
    const glm::vec3 north_end(street * block_m - half + (south ? -1.75f : 1.75f), 0, from),
        south_end = north_end + glm::vec3(0, 0, length), velocity(0, 0, south ? speed : -speed);
    const std::uint32_t yaw =
        south ? 3u << 14 : 1u << 14;  // turns from east towards north, times 65536
    const auto first = static_cast<std::uint32_t>(traffic.knots.size());
    traffic.knots.push_back({south ? north_end : south_end, 0, velocity, yaw});
    traffic.knots.push_back({south ? south_end : north_end, trip_s, velocity, yaw});
    traffic.trips.push_back({first, 2, 0, 0, 0, static_cast<std::uint32_t>(i), {}});
  }
}

}  // namespace

scene::RenderScene make_lamp_field(std::size_t lamps, std::size_t vehicles) {
  auto blocks = static_cast<int>(std::ceil(std::sqrt(double(lamps) / lamps_a_block)));
  blocks += blocks % 2;  // so that a street runs through the middle
  const float half = 0.5f * block_m * float(blocks);
  std::mt19937 random(7);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };

  Scene scene;
  scene.materials.push_back({"plain", glm::vec3(0.4f), glm::vec3(0), 1.0f, true});
  ScenePrimitive houses;
  const float edge = half + block_m;
  append_quad(houses, {{{-edge, 0, -edge}, {-edge, 0, edge}, {edge, 0, edge}, {edge, 0, -edge}}});
  scene::SceneLights lights;
  // Lamps fill the field row by row: only whole fields are compared, so the order does not matter.
  for (int z = 0; z < blocks; ++z)
    for (int x = 0; x < blocks; ++x) {
      const glm::vec3 corner(float(x) * block_m - half, 0, float(z) * block_m - half);
      for (const float at : {12.0f, 44.0f})
        append_house(houses, corner + glm::vec3(at, 0, 12),
                     corner + glm::vec3(at + 24, uniform(8, 24), 68));
      for (int i = 0; i < lamps_a_block && lights.lights.size() < lamps; ++i) {
        const float along = block_m * (float(i % lamps_a_side) + 0.5f) / lamps_a_side,
                    side = uniform(2, 4);
        const bool flood = lights.lights.size() % 50 == 25;
        const glm::vec3 foot =
            i < lamps_a_side ? glm::vec3(along, 0, side) : glm::vec3(side, 0, along);
        lights.lights.push_back(street_lamp(corner + foot + glm::vec3(0, flood ? 14 : 6, 0),
                                            flood ? 60000.0f : uniform(2000, 8000)));
      }
    }
  if (vehicles > 0) add_vehicles(lights, vehicles, blocks + 1, half, uniform);
  scene.meshes.push_back({"houses", {std::move(houses)}});
  scene.nodes.push_back({"houses", "city", 0, true, {SceneInstance{}}});
  return scene::make_render_scene(scene, std::move(lights));
}

scene::CameraPose lamp_field_camera() {
  scene::CameraPose pose;
  pose.position = {-6, 30, 70};
  pose.target = {2, 0, -20};
  pose.fov_deg = 50;
  return pose;
}

}  // namespace nightcity::experiments
