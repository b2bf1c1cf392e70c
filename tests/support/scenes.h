// Small scenes with known answers, built in memory.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "formats/rgb9e5.h"
#include "runtime/scene/brute_force.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::test {

/// Returns lights as scenes hold them.
inline LargeVector<Light> to_large(const std::vector<Light>& lights) {
  return {lights.begin(), lights.end()};
}

/// A camera 30 m above the origin.
inline const scene::CameraPose looking_down{{0, 30, 0}, {0, 0, 0}, {0, 0, -1}, 40};

/// Returns a lamp without a profile at `position`, aimed down; radius in m, flux in lumen.
inline Light lamp(const glm::vec3& position, float flux_lm, float radius = 0.05f) {
  Light light{};
  light.position = position;
  light.radius = radius;
  light.axis = {0, -1, 0};
  light.tangent = {1, 0, 0};
  light.flux_lm = flux_lm;
  light.colour_rgb9e5 = encode_rgb9e5({1, 1, 1});
  light.kind_profile = pack_kind_profile(LightKind::sphere, LIGHT_NO_PROFILE);
  light.schedule = LIGHT_ALWAYS_ON;
  light.id = 1;
  return light;
}

/// Returns a one-sided window that faces `normal` and whose first edge is horizontal; lengths in m.
inline Light window(const glm::vec3& centre, const glm::vec3& normal, float half_width,
                    float half_height, float flux_lm) {
  Light light = lamp(centre, flux_lm, half_width);
  light.axis = normal;
  light.tangent = glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
  light.half_height = half_height;
  light.kind_profile = pack_kind_profile(LightKind::rectangle, LIGHT_NO_PROFILE);
  return light;
}

/// Collects quads and boxes of one material into a Scene.
class SceneBuilder {
 public:
  explicit SceneBuilder(float reflectance = 0.5f) {
    scene_.materials.push_back({"plain", glm::vec3(reflectance), glm::vec3(0), 1.0f, true});
    scene_.meshes.push_back({"city", {ScenePrimitive{}}});
    scene_.nodes.push_back({"city", "city", 0, true, {SceneInstance{}}});
  }

  SceneBuilder& quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    ScenePrimitive& p = scene_.meshes[0].primitives[0];
    const auto base = static_cast<std::uint32_t>(p.positions.size());
    p.positions.insert(p.positions.end(), {a, b, c, d});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(base + i);
    return *this;
  }

  /// Adds a horizontal square of half side `s` at height y.
  SceneBuilder& ground(float s, float y = 0) {
    return quad({-s, y, -s}, {-s, y, s}, {s, y, s}, {s, y, -s});
  }

  SceneBuilder& box(const glm::vec3& lo, const glm::vec3& hi) {
    const auto at = [&](int i) {
      return glm::vec3((i & 1) ? hi.x : lo.x, (i & 2) ? hi.y : lo.y, (i & 4) ? hi.z : lo.z);
    };
    for (const auto& f : {std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1},
                          std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}})
      quad(at(f[0]), at(f[1]), at(f[2]), at(f[3]));
    return *this;
  }

  /// Makes the material of all surfaces glow, cd/m2.
  SceneBuilder& glow(float luminance) {
    scene_.materials[0].emission_cd_m2 = glm::vec3(luminance);
    return *this;
  }

  Scene& scene() { return scene_; }
  const Scene& scene() const { return scene_; }
  scene::RenderScene with(const std::vector<Light>& lights) const {
    return scene::make_render_scene(scene_, {to_large(lights), {}, {}, {}});
  }

 private:
  Scene scene_;
};

/// Returns a place that is turned about the vertical at the origin, from x towards z.
inline glm::vec3 turned(const glm::vec3& v, float angle_deg) {
  const float c = std::cos(glm::radians(angle_deg)), s = std::sin(glm::radians(angle_deg));
  return {c * v.x - s * v.z, v.y, s * v.x + c * v.z};
}

/// Returns the same scene, turned.
inline SceneBuilder turned(SceneBuilder builder, float angle_deg) {
  for (glm::vec3& p : builder.scene().meshes[0].primitives[0].positions) p = turned(p, angle_deg);
  return builder;
}

/// Returns those of `lights` that have open sky above, so none inside or under a box.
inline std::vector<Light> under_open_sky(const SceneBuilder& builder, std::vector<Light> lights) {
  const scene::RenderScene scene = builder.with({});
  std::erase_if(lights, [&](const Light& light) {
    return scene::brute_force_hit(scene, glm::dvec3(light.position), {0.0, 1.0, 0.0}, 1e30,
                                  MASK_SHADOW)
        .has_value();
  });
  return lights;
}

/// Returns three boxes on a plane, with room for lamps between them; the wall at z = -10 is for
/// windows.
inline SceneBuilder boxes_on_a_plane() {
  SceneBuilder builder;
  builder.ground(40)
      .box({-3, 0, -3}, {-1, 4, 2})
      .box({2, 0, -2}, {4, 2.5f, 4})
      .box({-8, 0, -12}, {8, 6, -10});
  return builder;
}

/// Returns a ground with `count` boxes, 5 to 20 m high, in a square of half side `half`.
inline SceneBuilder random_town(int count, float half, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  SceneBuilder builder;
  builder.ground(half);
  for (int i = 0; i < count; ++i) {
    // Draws in separate statements: the order of evaluation of arguments is up to the compiler.
    const float z = uniform(-half, half), x = uniform(-half, half);
    const float depth = uniform(3, 9), height = uniform(5, 20), width = uniform(3, 9);
    builder.box({x, 0, z}, {x + width, height, z + depth});
  }
  return builder;
}

/// Adds `count` instances of a crown of 60 leaves, which are too many triangles to be stored for each
/// of them, in a square of half side `half`.
inline void add_trees(Scene& scene, int count, float half, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  SceneBuilder crown;
  for (int i = 0; i < 60; ++i) {
    const float z = uniform(-1, 1), y = uniform(-1, 1), x = uniform(-1, 1);
    const float tilt = uniform(-0.2f, 0.2f), lean = uniform(-0.2f, 0.2f);
    const glm::vec3 middle(x, y, z), u(0.2f, tilt, lean), v(lean, 0.1f, tilt);
    crown.quad(middle - u - v, middle + u - v, middle + u + v, middle - u + v);
  }
  SceneNode node{"crowns", "tree", static_cast<std::uint32_t>(scene.meshes.size()), true, {}};
  scene.meshes.push_back({"crown", crown.scene().meshes[0].primitives});
  for (int i = 0; i < count; ++i) {
    const float z = uniform(-half, half), x = uniform(-half, half), size = uniform(1, 4);
    glm::mat4 place = glm::translate(glm::mat4(1), glm::vec3(x, 2 + size, z));
    place = glm::scale(place, glm::vec3(size, 1.2f * size, size));
    node.instances.push_back({glm::rotate(place, uniform(0, 6), glm::vec3(0, 1, 0)), no_id});
  }
  scene.nodes.push_back(node);
}

/// Adds the ground around a square of half side `half`: a ring of triangles that rises to `rim` m
/// half way and then falls to `drop` m below the square at `reach`, turned by an angle.
inline void add_horizon(Scene& scene, float half, float rim, float drop, float reach,
                        float angle_deg = 0) {
  ScenePrimitive ring;
  const float at[] = {half, 2 * half, reach}, height[] = {0, rim, -drop};
  for (int r = 0; r < 3; ++r)
    for (int corner = 0; corner < 4; ++corner)
      ring.positions.push_back(turned(
          {corner == 0 || corner == 3 ? -at[r] : at[r], height[r], corner < 2 ? -at[r] : at[r]},
          angle_deg));
  for (std::uint32_t r = 0; r < 2; ++r)
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t a = 4 * r + corner, b = 4 * r + (corner + 1) % 4;
      ring.indices.insert(ring.indices.end(), {a, b, b + 4, a, b + 4, a + 4});
    }
  scene.nodes.push_back({"horizon",
                         "horizon",
                         static_cast<std::uint32_t>(scene.meshes.size()),
                         false,
                         {SceneInstance{}}});
  scene.meshes.push_back({"horizon", {ring}});
}

/// Returns a town at an angle, with trees among its houses and the ground around it.
inline SceneBuilder town_with_surroundings(float angle_deg) {
  SceneBuilder builder = turned(random_town(40, 60, 7), angle_deg);
  add_trees(builder.scene(), 40, 60, 5);
  add_horizon(builder.scene(), 60, 9, 200, 4000, angle_deg);
  return builder;
}

inline std::vector<Light> random_lamps(int count, float half, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  std::vector<Light> lights;
  for (int i = 0; i < count; ++i) {
    const float radius = uniform(0.05f, 0.3f), flux_lm = uniform(1000, 8000);
    const float x = uniform(-half, half), y = uniform(4, 9), z = uniform(-half, half);
    lights.push_back(lamp({x, y, z}, flux_lm, radius));
  }
  return lights;
}

}  // namespace nightcity::test
