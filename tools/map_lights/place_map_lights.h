// Places the lights of a map that are no street lamps: advertising, floodlights of buildings and
// pitches, petrol stations.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tools/lights/place_lamps.h"
#include "tools/lights/windows.h"
#include "tools/map_lights/ground.h"
#include "tools/map_lights/map_light_options.h"
#include "tools/osm/osm_data.h"

namespace nightcity::map_lights {

/// A body that carries a sign, or that is floodlit where the model shows nothing: a box, or a
/// column of six sides.
struct Body {
  glm::dvec3 foot{0};       // middle of its underside; E, N, H, m
  glm::dvec2 facing{0, 1};  // unit, along its depth
  double width_m = 0, height_m = 0, depth_m = 0;
  bool is_column =
      false;  // of a diameter `width_m` over its corners, one of which lies at `facing`
};

struct MapLightReport {
  struct Kind {
    std::size_t mapped = 0, lit = 0;  // things of the map
    std::size_t lights = 0;
    double flux_lm = 0;
    lights::HourCounts hours{};  // how many lights shine at each full hour
  };
  std::array<Kind, map_light_kind_count> kinds;
  std::map<std::string, std::size_t> left_out;  // things, by reason
  std::map<std::string, std::size_t> notes;     // values that could not be read
  // Name of a value, its source, number of lights.
  std::map<std::string, std::map<std::string, std::size_t>> sources;
};

struct MapLightSet {
  std::vector<lights::PlacedLamp> luminaires;  // floodlights and downlights
  std::vector<lights::LitRectangle> signs;
  std::vector<Body> bodies;
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  MapLightReport report;
};

/// Places all lights of the map's shining things. Each is where its thing is, so it lies in one
/// model, whatever else is in the map; what lies outside the model is left out and counted. A
/// pitch, building or petrol station by which the map has floodlights of its own (lamps that are
/// lighting masts) is left to those. `relations`: the map's multipolygons, each outer ring as a
/// closed way. The result depends on the map's content and on the ground alone.
MapLightSet place_map_lights(const osm::OsmData& map, const Ground& ground,
                             const MapLightOptions& options,
                             std::span<const osm::OsmShiningThing> relations = {});

}  // namespace nightcity::map_lights
