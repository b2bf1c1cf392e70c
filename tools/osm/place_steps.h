// Places in the steps of the resolution of maps.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>

#include "tools/osm/resolution.h"
#include "tools/random.h"

namespace nightcity::osm {

/// A place in steps of the resolution, east and north.
using PlaceSteps = std::pair<std::int64_t, std::int64_t>;

inline PlaceSteps round_to_steps(const glm::dvec2& lon_lat) {
  return {to_steps(lon_lat.x), to_steps(lon_lat.y)};
}

inline std::uint64_t hash_place(const PlaceSteps& steps) {
  return mix(mix(static_cast<std::uint64_t>(steps.first)) ^
             static_cast<std::uint64_t>(steps.second));
}

}  // namespace nightcity::osm
