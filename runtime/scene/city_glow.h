// The light that leaves a city upwards, as its sky needs it: few paths, followed when a scene is
// loaded, before there is a device. `nightview upward` follows many of each light on the device
// (runtime/render/upward_flux.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

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

/// A path of light that left a city upwards.
struct UpwardPath {
  std::uint32_t light;
  bool direct;  // it met no surface
  glm::dvec3 from, direction;
  glm::dvec3 share;  // lm per channel that the path carries of each lumen of the light
};

/// Follows `paths` paths of light from static lights, each light chosen in proportion to its
/// `weight` (finite, >= 0), off up to four surfaces, and returns those that leave upwards. Vehicles
/// are left out.
std::vector<UpwardPath> follow_upward_light(const RenderScene& scene, std::vector<double> weight,
                                            std::uint32_t paths);

/// Adds up what paths carry of lights of these fluxes, lm, 0 where one is off; `bounds` are those
/// of the scene. So the same paths tell the light of any time. Of n paths chosen by flux, a quarter
/// of which leave upwards, the sum has a relative standard error of about 2 / sqrt(n).
CityGlow find_city_glow(std::span<const UpwardPath> paths, std::span<const float> flux_lm,
                        const Box& bounds);

/// Adds the city around the scene that the model does not have, up to `radius_m` from the scene's
/// middle, as if it shone as the scene does on average.
void extend_city(CityGlow& glow, const Box& bounds, double radius_m);

}  // namespace nightcity::scene
