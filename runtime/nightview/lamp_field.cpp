#include "runtime/nightview/lamp_field.h"

#include <array>
#include <cmath>
#include <random>

#include "formats/rgb9e5.h"

namespace nightcity {
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
  const glm::vec3 a(lo.x, lo.y, hi.z), b(hi.x, lo.y, hi.z), c(hi.x, lo.y, lo.z), d(lo.x, lo.y, lo.z);
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
  light.kind_profile = LIGHT_SPHERE | LIGHT_NO_PROFILE << 8;
  light.schedule = LIGHT_ALWAYS_ON;
  return light;
}

}  // namespace

RenderScene lamp_field(std::size_t lamps) {
  auto blocks = static_cast<int>(std::ceil(std::sqrt(double(lamps) / lamps_a_block)));
  blocks += blocks % 2;  // a street runs through the middle
  const float half = 0.5f * block_m * float(blocks);
  std::mt19937 random(7);
  const auto uniform = [&](float a, float b) { return a + (b - a) * float(random() >> 8) / 16777216.0f; };

  Scene scene;
  scene.materials.push_back({"plain", glm::vec3(0.4f), glm::vec3(0), 1.0f, true});
  ScenePrimitive houses;
  const float edge = half + block_m;
  append_quad(houses, {{{-edge, 0, -edge}, {-edge, 0, edge}, {edge, 0, edge}, {edge, 0, -edge}}});
  SceneLights lights;
  // From the middle outwards would be prettier; row by row is as good, since only whole fields are compared.
  for (int z = 0; z < blocks; ++z)
    for (int x = 0; x < blocks; ++x) {
      const glm::vec3 corner(float(x) * block_m - half, 0, float(z) * block_m - half);
      for (const float at : {12.0f, 44.0f})
        append_house(houses, corner + glm::vec3(at, 0, 12), corner + glm::vec3(at + 24, uniform(8, 24), 68));
      for (int i = 0; i < lamps_a_block && lights.lights.size() < lamps; ++i) {
        const float along = block_m * (float(i % lamps_a_side) + 0.5f) / lamps_a_side, side = uniform(2, 4);
        const bool flood = lights.lights.size() % 50 == 25;
        const glm::vec3 foot = i < lamps_a_side ? glm::vec3(along, 0, side) : glm::vec3(side, 0, along);
        lights.lights.push_back(street_lamp(corner + foot + glm::vec3(0, flood ? 14 : 6, 0),
                                            flood ? 60000.0f : uniform(2000, 8000)));
      }
    }
  scene.meshes.push_back({"houses", {std::move(houses)}});
  scene.nodes.push_back({"houses", "city", 0, true, {SceneInstance{}}});
  return make_render_scene(scene, std::move(lights));
}

CameraPose lamp_field_camera() {
  CameraPose pose;
  pose.position = {-6, 30, 70};
  pose.target = {2, 0, -20};
  pose.fov_deg = 50;
  return pose;
}

}  // namespace nightcity
