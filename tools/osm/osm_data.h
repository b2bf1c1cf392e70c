// What an OSM reader delivers: the lamps and roads a night scene wants, in WGS 84, with their tags as
// written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

namespace nightcity {

using OsmTags = std::map<std::string, std::string>;

struct OsmLampNode {
  std::int64_t id = 0;
  glm::dvec2 lon_lat{0, 0};  // degrees
  OsmTags tags;
};

struct OsmWay {
  std::int64_t id = 0;
  std::vector<glm::dvec2>
      lon_lat;  // degrees; nodes missing from the extract are left out and counted
  OsmTags tags;
};

struct OsmData {
  std::vector<OsmLampNode> lamps;  // street_lamp, lantern, floodlight, tower:type=lighting, ...
  std::vector<OsmWay> highways;
  std::vector<OsmWay> buildings;
  std::size_t nodes = 0, ways = 0, relations = 0;
  std::size_t missing_nodes = 0, bad_coordinates = 0, duplicates = 0;

  /// Appends, dropping elements whose id is already there (extracts overlap).
  void merge(OsmData&& other);
};

/// .osm by pugixml; .osm.pbf, .osm.gz, .osm.bz2 by libosmium. Throws Error: missing, broken, not OSM.
OsmData read_osm(const std::filesystem::path& file);

}  // namespace nightcity
