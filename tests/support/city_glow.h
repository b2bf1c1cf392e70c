// The light that leaves a city upwards at one time.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/city_glow.h"
#include "runtime/scene/lit_lights.h"

namespace nightcity::test {

/// Follows paths of the lights that shine at a time (s since noon) alone, chosen by their flux.
inline scene::CityGlow find_city_glow(const scene::RenderScene& scene, double time_s,
                                      scene::LightFamilies on = scene::all_families,
                                      std::uint32_t paths = 16384) {
  const std::vector<float> flux = scene::flux_of(
      scene::lit_lights(scene.lights, scene.families, scene.schedules, scene.switches, time_s, on),
      scene.lights);
  return scene::find_city_glow(scene::follow_upward_light(scene, {flux.begin(), flux.end()}, paths),
                               flux, scene.bounds);
}

}  // namespace nightcity::test
