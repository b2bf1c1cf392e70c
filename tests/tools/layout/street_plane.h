// A flat Earth with streets drawn in metres, for the tests of layouts.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::test {

constexpr double metres_per_degree =
    100000;  // so that a metre is 100 of OSM's units: nodes stay exact

inline glm::dvec2 to_plane(const glm::dvec2& lon_lat) {
  return lon_lat * metres_per_degree;
}

inline osm::OsmWay street(std::int64_t id, std::vector<glm::dvec2> line, osm::OsmTags tags) {
  osm::OsmWay way{id, {}, std::move(tags)};
  for (const glm::dvec2& p : line) way.lon_lat.push_back(p / metres_per_degree);
  return way;
}

inline std::optional<double> plane(const glm::dvec2& p) {
  return std::abs(p.x) <= 1000 && std::abs(p.y) <= 1000 ? std::optional<double>(40) : std::nullopt;
}

}  // namespace nightcity::test
