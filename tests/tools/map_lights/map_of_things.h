// Lights of a map of a few things on flat ground.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "tests/tools/map_lights/flat_ground.h"
#include "tools/map_lights/place_map_lights.h"

namespace nightcity::map_lights {

using Thing = osm::OsmShiningThing;

inline Thing node(std::int64_t id, glm::dvec2 at, osm::OsmTags tags) {
  return {id, false, {at}, std::move(tags)};
}

inline Thing area(std::int64_t id, glm::dvec2 low, glm::dvec2 high, osm::OsmTags tags) {
  return {id, true, {low, {high.x, low.y}, high, {low.x, high.y}, low}, std::move(tags)};
}

inline MapLightSet place(std::vector<Thing> things, const MapLightOptions& options = {},
                         const Ground& ground = test::make_flat_ground(), osm::OsmData map = {}) {
  map.shining_things = std::move(things);
  return place_map_lights(map, ground, options);
}

inline const MapLightReport::Kind& kind_of(const MapLightSet& set, MapLightKind kind) {
  return set.report.kinds[static_cast<std::size_t>(kind)];
}

inline osm::OsmData make_street() {  // along the x axis
  osm::OsmData map;
  map.highways = {{7, {{-200, 0}, {200, 0}}, {{"highway", "residential"}}}};
  return map;
}

inline const osm::OsmTags soccer{{"leisure", "pitch"}, {"sport", "soccer"}, {"lit", "yes"}};

}  // namespace nightcity::map_lights
