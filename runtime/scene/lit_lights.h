// The lights that shine at a given time, and the tables that they are sampled from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/night.h"
#include "formats/schedule.h"
#include "runtime/scene/light_families.h"
#include "shaders/scene_types.h"

namespace nightcity::scene {

struct LitLights {
  std::vector<std::uint32_t> bits;     // one bit per light, 32 per word
  std::vector<std::uint32_t> list;     // indices of the lights that shine, ascending
  std::vector<gpu::AliasEntry> alias;  // over flux, parallel to the lights, where it was made
  double flux_lm = 0;                  // of all that shine
  TimeSpan steady;                     // the same lights shine

  bool same_lights(const LitLights& other) const { return bits == other.bits; }
};

/// Returns bits, list, flux and `steady` only, which is cheap enough for every step of a clock.
/// `families`: parallel to the lights; those outside `on` are off.
LitLights lit_lights(std::span<const Light> lights, std::span<const LightFamily> families,
                     std::span<const Schedule> schedules, std::span<const std::uint32_t> switches,
                     double time_s, LightFamilies on = all_families);

/// Returns the flux of each light in lumens, 0 where it is off.
std::vector<float> flux_of(const LitLights& lit, std::span<const Light> lights);

}  // namespace nightcity::scene
