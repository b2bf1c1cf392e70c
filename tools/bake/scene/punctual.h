// The brightest lights of a scene for programs that know no city.lights: as KHR_lights_punctual.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "formats/light.h"
#include "formats/scene_file.h"

namespace nightcity {

/// The light as one without size, its flux kept: the intensity makes the integral of the extension's own
/// falloff (the one its text recommends) the light's lumens. Lamps whose light stays below become spots as
/// wide as 99 % of their flux, others points; windows spots whose axis has a Lambertian's candela, flux / pi.
/// `profile_data` as the profiles point into it.
ScenePunctual punctual_of(const Light& light, std::span<const LightProfile> profiles,
                          std::span<const float> profile_data);

/// Lumens per candela of a spot: the integral of saturate((cos - cos outer) / (cos inner - cos outer))^2.
double spot_solid_angle(double inner_rad, double outer_rad);

/// Keeps the `most` lights of the greatest flux.
class BrightestLights {
 public:
  explicit BrightestLights(std::size_t most) : most_(most) {}
  void add(const Light& light);
  /// In the order in which they came.
  std::vector<Light> take() &&;

 private:
  std::size_t most_, count_ = 0;
  std::vector<std::pair<std::size_t, Light>> heap_;  // number and light, the faintest first
};

}  // namespace nightcity
