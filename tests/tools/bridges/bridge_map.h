// Small maps of bridges, in metres.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "tools/bridges/bridge_decks.h"

namespace nightcity::test {

// Maps have degrees; these have one for every 100 km, both ways.
constexpr double metres_a_degree = 1e5;

inline glm::dvec2 to_metres(const glm::dvec2& lon_lat) {
  return lon_lat * metres_a_degree;
}

inline osm::OsmWay way(std::int64_t id, std::vector<glm::dvec2> metres, osm::OsmTags tags) {
  for (glm::dvec2& p : metres) p /= metres_a_degree;
  return {id, std::move(metres), std::move(tags)};
}

inline std::optional<double> level_ground(const glm::dvec2&) {
  return 30.0;
}

inline osm::OsmTags with(osm::OsmTags tags, const osm::OsmTags& more) {
  for (const auto& [key, value] : more) tags[key] = value;
  return tags;
}

inline const osm::OsmTags residential{{"highway", "residential"}},
    bridge{{"highway", "residential"}, {"bridge", "yes"}, {"layer", "1"}};

/// A street over another one: its bridge has 200 m in two ways.
inline std::vector<osm::OsmWay> street_over_street() {
  return {way(1, {{-300, 0}, {-100, 0}}, residential), way(2, {{-100, 0}, {10, 0}}, bridge),
          way(3, {{100, 0}, {10, 0}}, bridge), way(4, {{100, 0}, {300, 0}}, residential),
          way(5, {{0, -200}, {0, 200}}, residential)};
}

}  // namespace nightcity::test
