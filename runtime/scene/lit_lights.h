// Which lights shine at a moment of the night, and the tables they are picked from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/night.h"
#include "runtime/scene/light_grid.h"

namespace nightcity {

struct LitLights {
  std::vector<std::uint32_t> bits;     // a bit a light, 32 a word
  std::vector<std::uint32_t> list;     // indices of those that shine, ascending
  std::vector<gpu::AliasEntry> alias;  // over flux, parallel to the lights
  LightGrid near_grid;                 // the strongest near each place
  LightGrid far_grid;                  // those of the quarter around it

  bool same_lights(const LitLights& other) const { return bits == other.bits; }
};

/// Bits and list only: cheap enough to ask at every step of a clock.
LitLights lit_lights(std::span<const Light> lights, std::span<const Schedule> schedules,
                     std::span<const std::uint32_t> switches, double time_s);

/// Fills in the tables. A light without flux never shines.
void build_tables(LitLights& lit, std::span<const Light> lights);

}  // namespace nightcity
