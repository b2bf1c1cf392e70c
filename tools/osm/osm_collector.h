// Makes OsmData from the nodes and ways that all parsers deliver, file after file, in any order.
#pragma once

#include <compare>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tools/osm/days.h"
#include "tools/osm/lamp_relations.h"
#include "tools/osm/osm_data.h"
#include "tools/osm/osm_elements.h"
#include "tools/today.h"

namespace nightcity::osm {

class OsmCollector {
 public:
  explicit OsmCollector(std::size_t max_way_nodes = default_max_way_nodes)
      : max_way_nodes_(max_way_nodes) {}

  /// Begins another file. Negative ids are an editor's own: nodes and ways with such an id are the
  /// same in one file only.
  void begin_file() { ++file_; }

  /// Leaves out and counts whatever is gone today or not built yet; lamps say themselves why they
  /// do not shine. `tags` may be empty. Coordinates in degrees; nodes that are not finite or off
  /// the globe are counted and skipped, except for deleted ones.
  void add_node(std::int64_t id, OsmVersion version, const glm::dvec2& lon_lat, OsmTags tags);
  void count_bad_node() {
    if (!reads_members_) ++nodes_, ++data_.bad_coordinates;
  }
  void add_way(std::int64_t id, OsmVersion version, std::vector<OsmNodeRef> nodes, OsmTags tags);
  void add_relation(std::int64_t id, OsmVersion version, OsmRelation relation);
  /// Adds the rectangle that a file says it holds; it may say several.
  void add_bounds(LonLatBox box);
  void add_remark(std::string text) {
    if (!reads_members_) data_.remarks.push_back(std::move(text));
  }

  /// Returns whether the same files have to come once more, for the members of relations, and then
  /// takes these alone.
  bool begin_members();

  /// Gives the ways their coordinates and returns everything. Of several versions of an element the
  /// newest counts, of equal ones the first.
  OsmData finish() &&;

 private:
  // An id, and the file if it is negative. Four-byte members keep Place at 24 bytes, because
  // extracts have many millions of nodes.
  struct Key {
    std::uint32_t high = 0, low = 0, file = 0;
    auto operator<=>(const Key&) const = default;
  };
  // Coordinates in OSM's own resolution of 1e-7 degrees.
  struct Place {
    Key key;
    std::uint32_t rank;
    std::int32_t lon, lat;  // a deleted node has no longitude that exists
  };
  struct State {
    Key key;
    std::uint32_t rank;
    bool deleted;
  };
  struct PendingLamp {
    OsmLampNode lamp;
    Key key;
    std::uint32_t rank;
  };
  struct PendingPoint {
    OsmPoint point;
    Key key;
    std::uint32_t rank;
  };
  struct PendingThing {
    OsmShiningThing thing;
    Key key;
    std::uint32_t rank;
  };
  struct PendingWay {
    OsmWay way;
    std::vector<OsmNodeRef> nodes;
    Key key;
    std::uint32_t rank;
    std::uint32_t file;
  };

  Key key_of(std::int64_t id) const;
  template <class Entry>
  static void keep_newest(std::vector<Entry>& entries);
  template <class Entry>
  static const Entry* find(const std::vector<Entry>& entries, const Key& key);
  template <class Pending, class Entry>
  void drop_old(std::vector<Pending>& pending, const std::vector<Entry>& newest);
  void place_points(std::vector<PendingPoint>& pending, std::vector<OsmPoint>& points);
  void place_ways();
  void add_lamps_of_relations();

  OsmData data_;
  std::size_t max_way_nodes_;
  Day today_ = today();
  std::size_t nodes_ = 0;
  std::uint32_t file_ = 0, bounded_file_ = 0;
  std::size_t bounded_files_ = 0;
  std::vector<Place> places_;
  std::vector<State> way_states_;
  std::vector<PendingLamp> lamps_;
  std::vector<PendingPoint> trees_, controls_, crossings_, gates_, squares_;
  std::vector<PendingThing> things_;
  std::vector<PendingWay> pending_;
  LampRelations relations_;
  bool reads_members_ = false;
};

}  // namespace nightcity::osm
