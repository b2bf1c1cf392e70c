// Sets of families of lights: which of them shine, whatever the time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/light_file.h"

namespace nightcity::scene {

/// A bit 1 << LightFamily for each family of the set.
using LightFamilies = std::uint32_t;

constexpr LightFamilies all_families = (1u << light_family_count) - 1;

constexpr LightFamilies to_set(LightFamily family) {
  return 1u << static_cast<std::uint32_t>(family);
}

/// A time in seconds since noon, and the families that may shine then.
struct LightMoment {
  double time_s = 0;
  LightFamilies on = all_families;
};

/// Returns whether the set has the family; a value out of range counts as `other`.
bool has_family(LightFamilies set, LightFamily family);

/// Converts a list of name_of(LightFamily), as "lamp,window", or "all" or "none". Throws
/// UsageError, which names the option --lights.
LightFamilies parse_families(const std::string& text);
/// Returns what parse_families takes.
std::string text_of(LightFamilies set);

/// Returns the lights of vehicles with those of families outside the set dark. The light file keeps
/// the family of such a light in its id (formats/SPEC.md, 3.7).
std::vector<Light> darkened(std::span<const Light> vehicle_lights, LightFamilies on);

}  // namespace nightcity::scene
