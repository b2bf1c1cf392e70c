// The brightest lights of a scene as KHR_lights_punctual, for programs that cannot read
// city.lights.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "formats/light.h"
#include "formats/scene.h"

namespace nightcity::bake {

/// Returns a light without size and with the same flux: its intensity times the integral of the
/// extension's falloff (the one that its text recommends) is the light's lumens. A lamp that shines
/// downwards only becomes a spot that holds 99 % of its flux, another lamp a point, and a window a
/// spot with the intensity of a Lambertian emitter on its axis, flux / pi. The profiles point into
/// `profile_data`.
ScenePunctual to_punctual(const Light& light, std::span<const LightProfile> profiles,
                          std::span<const float> profile_data);

/// Returns the lumens per candela of a spot: the integral of saturate((cos - cos outer) / (cos
/// inner - cos outer))^2.
double find_spot_solid_angle(double inner_rad, double outer_rad);

/// Keeps the `max_lights` lights of the greatest flux.
class BrightestLights {
 public:
  explicit BrightestLights(std::size_t max_lights) : max_lights_(max_lights) {}
  void add(const Light& light);
  /// Returns them in the order in which they were added.
  std::vector<Light> take() &&;

 private:
  std::size_t max_lights_, count_ = 0;
  std::vector<std::pair<std::size_t, Light>> heap_;  // number and light, the faintest first
};

}  // namespace nightcity::bake
