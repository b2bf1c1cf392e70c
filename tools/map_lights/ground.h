// Questions that lights ask about the ground and the buildings where they stand.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>

#include "tools/place/site.h"

namespace nightcity::map_lights {

/// The part of a vertical line that a building of the model fills: from its underside to its roof,
/// m.
struct SolidSpan {
  double low_m = 0, high_m = 0;
};
using SolidAt = std::function<std::optional<SolidSpan>(const glm::dvec2& place)>;

struct Ground {
  place::LonLatToFrame to_frame;
  place::HeightAt height_at;
  place::InsideBuilding inside;  // empty: there are no buildings
  SolidAt solid_at;              // empty: there are none

  bool is_inside(const glm::dvec2& place) const { return inside && inside(place); }
  std::optional<SolidSpan> find_solid(const glm::dvec2& place) const {
    return solid_at ? solid_at(place) : std::nullopt;
  }
};

}  // namespace nightcity::map_lights
