// The light that leaves a city upwards, as its sky needs it: few paths, followed when a scene is
// loaded, before there is a device. `nightview upward` follows many of each light on the device
// (runtime/render/upward_flux.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/scene/light_families.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

struct CityGlow {
  /// A square of the city.
  struct Source {
    glm::dvec2 place;  // x and z of its middle, model space, m
    double radius_m;
    double flux_lm;  // that leaves it upwards
  };
  static constexpr std::size_t bands = 18;

  std::vector<Source> sources;
  // The share of all sources' flux in each band of 5 degrees above the horizon.
  std::array<double, bands> band_share{};
  glm::dvec3 colour{1};  // linear Rec. 709 of luminance 1
  double lamp_flux_lm = 0;
  double direct_lm = 0, reflected_lm = 0;  // that leave upwards, straight and after bounces

  double flux_lm() const { return direct_lm + reflected_lm; }
};

/// Follows `paths` paths of light from the static lights that shine at a time (s since noon), each
/// chosen in proportion to its flux, off up to four surfaces. The flux has a relative standard
/// error of about 2 / sqrt(paths) where a quarter of the paths leave upwards. Vehicles are left
/// out.
CityGlow find_city_glow(const RenderScene& scene, double time_s, LightFamilies on = all_families,
                        std::uint32_t paths = 16384);

/// Adds the city around the scene that the model does not have, up to `radius_m` from the scene's
/// middle, as if it shone as the scene does on average.
void extend_city(CityGlow& glow, const Box& bounds, double radius_m);

}  // namespace nightcity::scene
