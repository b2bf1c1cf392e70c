// Statistics of a light file: kinds, lumens, hours, and where each value came from.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>

#include "formats/light_file.h"
#include "tools/lights/night_schedule.h"

namespace nightcity::lights {

struct FamilyStatistics {
  std::size_t count = 0, always_on = 0;
  double flux_lm = 0;
  std::map<std::string, std::size_t> kinds;                           // "sphere", "rectangle"
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // value, source, count
  std::array<std::size_t, night_hours> lit{};                         // at each full hour
};

struct LightStatistics {
  std::map<std::string, FamilyStatistics> families;  // "lamp", "window", ...
  std::map<std::string, std::size_t> faults;         // why lights are unfit, and how many
};

/// Returns why a light should not be where it is ("below the ground"), or ""; in model space.
using PlaceFault = std::function<std::string(const Light&)>;

/// Counts all lights of a file. Broken lights are counted in `faults` only.
LightStatistics count_lights(const LightFile& file, const PlaceFault& place_fault = {});

}  // namespace nightcity::lights
