// The buildings of a map as areas: closed ways and multipolygons.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::map_buildings {

/// Longitude and latitude in degrees; rings are open.
struct MapRings {
  std::vector<glm::dvec2> outer;
  std::vector<std::vector<glm::dvec2>> holes;
};

struct MapArea {
  std::string id;  // "way/123", "relation/45"
  osm::OsmTags tags;
  std::vector<MapRings> rings;
};

struct MapAreas {
  std::vector<MapArea> buildings;  // building=*
  std::vector<MapArea> parts;      // building:part=*, and no building
  std::size_t broken = 0;          // ways and multipolygons that enclose nothing or lack nodes
  std::size_t too_long = 0;        // ways and multipolygons of more than `max_nodes`
};

/// Reads all areas with a building or building:part, of several versions of one the newest. Memory
/// grows with them and with the nodes of the map. Areas whose ways have more than `max_nodes` nodes
/// together are left out: the time that it takes to assemble rings grows with their square. Throws
/// Error: missing or broken.
MapAreas read_map_areas(const std::filesystem::path& file, std::size_t max_nodes);

/// Returns longitude and latitude of up to `count` nodes from the file's beginning.
std::vector<glm::dvec2> read_first_nodes(const std::filesystem::path& file, std::size_t count);

}  // namespace nightcity::map_buildings
