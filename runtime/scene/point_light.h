// The light that reaches one point straight from the scene's static lights, light by light.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/scene/light_families.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

struct LightShare {
  std::size_t light;  // index
  double lux;         // illuminance that it gives, shadows counted
  double distance_m;
};

struct PointLight {
  std::vector<LightShare> strongest;  // descending
  double lux = 0;                     // of all of them
  std::size_t lit = 0;                // lights that give any
  std::size_t untested = 0;           // faint ones that were left out, together below a thousandth
};

/// Returns the luminous intensity per lumen that a sphere's profile has towards unit `to`, cd/lm,
/// as shaders/lights.glsl does.
double intensity_per_lumen(const RenderScene& scene, const Light& light, const glm::dvec3& to);

/// Returns the illuminance in lux that a light gives, without shadows, to a surface at `point`
/// whose unit normal is `normal`: I cos / d^2 with the profile's intensity; a rectangle is summed
/// over patches where it is near.
double illuminance_of(const RenderScene& scene, const Light& light, const glm::dvec3& point,
                      const glm::dvec3& normal);

/// Returns the `most` strongest static lights at a point of a surface at a time of the night (s
/// since noon), and what all give together. Each light is tested for shadow by one ray to its
/// centre. Lights of families outside `on` are off.
/// Vehicles and bounces are not in it.
PointLight find_light_at(const RenderScene& scene, const glm::dvec3& point,
                         const glm::dvec3& normal, double time_s, std::size_t most,
                         LightFamilies on = all_families);

}  // namespace nightcity::scene
