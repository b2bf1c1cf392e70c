// Makes OsmData from the nodes and ways that both parsers deliver in any order.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity {

class OsmCollector {
 public:
  /// `tags` may be empty. Coordinates in degrees; nodes that are not finite or off the globe are
  /// counted and skipped.
  void add_node(std::int64_t id, const glm::dvec2& lon_lat, OsmTags tags);
  void count_bad_node() { ++nodes_, ++data_.bad_coordinates; }
  void add_way(std::int64_t id, std::vector<std::int64_t> nodes, OsmTags tags);
  void count_relation() { ++data_.relations; }

  /// Gives the ways their coordinates and returns everything. Of elements that come twice in one
  /// file the first counts.
  OsmData finish() &&;

 private:
  // In OSM's own resolution of 1e-7 degrees: 16 bytes per node, because extracts have many
  // millions.
  struct Place {
    std::int64_t id;
    std::int32_t lon, lat;
  };
  struct PendingWay {
    OsmWay way;
    std::vector<std::int64_t> nodes;
    bool highway;
  };

  OsmData data_;
  std::size_t nodes_ = 0;
  std::vector<Place> places_;
  std::vector<PendingWay> pending_;
};

}  // namespace nightcity
