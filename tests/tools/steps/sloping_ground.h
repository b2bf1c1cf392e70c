// Ground that rises to the east, a map whose coordinates are metres, and steps on it.
#pragma once

#include <cmath>
#include <optional>

#include "tools/steps/find_steps.h"

namespace nightcity::steps {

inline const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
constexpr ground_cover::Box bounds{{-500, -500}, {500, 500}};
constexpr double slope = 0.4;

/// Ground at a height of 100 m at x = 0.
inline const place::HeightAt sloping = [](const glm::dvec2& p) {
  return std::abs(p.x) <= 500 ? std::optional(100 + slope * p.x) : std::nullopt;
};

inline osm::OsmWay make_way(std::vector<glm::dvec2> line, osm::OsmTags tags = {}) {
  tags.emplace("highway", "steps");
  return {1, std::move(line), std::move(tags)};
}

inline StepSet find(const std::vector<osm::OsmWay>& ways, const place::HeightAt& ground = sloping,
                    const place::InsideBuilding& inside = {}) {
  ground_cover::Cover cover;
  cover.finish();
  return find_steps(ways, cover, bounds, as_metres, ground, inside);
}

}  // namespace nightcity::steps
