// The areas of a map: closed ways and multipolygons.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/osm/days.h"
#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Longitude and latitude in degrees; rings are open. In a map across the antimeridian, longitudes
/// in the west count on beyond 180 degrees.
struct MapRings {
  std::vector<glm::dvec2> outer;
  std::vector<std::vector<glm::dvec2>> holes;

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(outer, holes);
  }
};

struct MapArea {
  std::string id;  // "way/123", "relation/45"
  OsmTags tags;
  std::vector<MapRings> rings;

  /// Passes each field to an archive, as those of MapRings.
  template <class Archive>
  void visit(Archive& archive) {
    archive(id, tags, rings);
  }
};

/// A node of its own: a tank or a tower that nobody has drawn an outline of. Longitudes count as
/// those of MapRings.
struct MapPoint {
  std::string id;  // "node/123"
  OsmTags tags;
  glm::dvec2 lon_lat{0, 0};
};

/// Selects areas that have one of these tags and whose tags `wants` accepts (empty: all).
struct AreaSelection {
  std::vector<std::string> keys;
  std::function<bool(const OsmTags&)> wants{};
  std::optional<Day> day{};   // what is gone then or not built yet is left out and counted
  bool keeps_points = false;  // nodes that are selected are returned, and not only counted
};

struct MapAreas {
  std::vector<MapArea> areas;  // in the file's order
  std::size_t broken = 0;      // closed ways and multipolygons that enclose nothing or lack nodes
  std::size_t open_ways = 0;   // ways that were selected and are not closed
  // Ways and multipolygons of more than `max_nodes`, or of a way that 64 have had before.
  std::size_t too_long = 0;
  std::size_t gone = 0;               // areas that are not there on the selection's day
  std::size_t points = 0;             // nodes that were selected, which have no outline
  std::vector<MapPoint> kept_points;  // these nodes, by the text of their ids
  std::vector<std::string> replaced;  // ways that are no areas, but outlines of multipolygons
};

/// Reads all areas that are selected, of several versions of one the newest. A relation of
/// type=building with selected tags is its outline. Memory grows with them
/// and with the nodes of the map. Areas whose ways have more than `max_nodes` nodes together are
/// left out, because the time that it takes to assemble rings grows with their square, and so are
/// multipolygons beyond the 64th of one way. Throws Error: missing or broken.
MapAreas read_map_areas(const std::filesystem::path& file, const AreaSelection& selection,
                        std::size_t max_nodes);

}  // namespace nightcity::osm
