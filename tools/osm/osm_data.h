// The part of OSM data that a night scene uses: lamps, roads and buildings in WGS 84, with their
// tags as written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::osm {

using OsmTags = std::map<std::string, std::string>;

struct OsmLampNode {
  std::int64_t id = 0;
  glm::dvec2 lon_lat{0, 0};  // degrees
  OsmTags tags;
  bool is_way = false;        // mapped as a line or an area, in the middle of which it stands
  bool is_inventory = false;  // of a town's inventory and not of the map
};

/// A node that is a thing of its own: a tree, a gate, a sign.
struct OsmPoint {
  glm::dvec2 lon_lat{0, 0};  // degrees, the very bits that ways through the node have there
  OsmTags tags;
};

/// A thing that may shine without being a lamp: a sign, a floodlit monument, a pitch, a petrol
/// station.
struct OsmShiningThing {
  std::int64_t id = 0;
  bool is_way = false;
  std::vector<glm::dvec2> lon_lat;  // degrees; a node has one place, a closed way repeats its first
  OsmTags tags;
};

struct OsmWay {
  std::int64_t id = 0;
  std::vector<glm::dvec2>
      lon_lat;  // degrees; nodes missing from the extract are skipped and counted
  OsmTags tags;

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(id, lon_lat, tags);
  }
};

/// A rectangle of longitudes and latitudes, degrees. Across the antimeridian longitudes are counted
/// on beyond 180 or -180.
struct LonLatBox {
  glm::dvec2 low{0, 0}, high{0, 0};
};

/// Nodes of a way. OpenStreetMap itself allows 2,000; files made of other data have longer lines.
constexpr std::size_t default_max_way_nodes = 20'000;

/// Streets, or tracks, that meet in one place; more are left out, and counted. No junction has as
/// many.
constexpr std::size_t max_streets_at_node = 64;

struct OsmData {
  std::vector<OsmLampNode> lamps;  // street_lamp, lantern, floodlight, tower:type=lighting, ...
  std::vector<OsmWay> highways;
  std::vector<OsmWay> buildings;
  std::vector<OsmPoint> trees;       // natural=tree
  std::vector<OsmWay> tree_rows;     // natural=tree_row
  std::vector<OsmWay> barriers;      // barrier=wall, hedge, fence, ...
  std::vector<OsmWay> railways;      // railway=rail, tram, platform, ...
  std::vector<OsmWay> watercourses;  // waterway=river, stream, ...; natural=coastline
  std::vector<OsmPoint> controls;    // nodes with highway=stop, give_way, traffic_signals
  std::vector<OsmPoint> crossings;   // nodes with highway=crossing
  std::vector<OsmPoint> gates;       // nodes with barrier=gate, entrance, ...
  std::vector<OsmPoint> squares;     // nodes with place=square
  std::vector<OsmShiningThing> shining_things;  // by id, nodes first
  std::size_t nodes = 0, ways = 0, relations = 0;
  // Relations that are barriers, and that may be buildings: read_map_areas has their outlines.
  std::size_t barrier_relations = 0, building_relations = 0;
  std::size_t missing_nodes = 0, bad_coordinates = 0, duplicates = 0;
  std::size_t old_versions = 0;  // lamps, highways and buildings of which there is a newer version
  std::size_t lamp_relations = 0;  // left out: none of their members is in the map
  std::size_t roof_lines = 0;      // not read: roof:ridge and roof:edge
  std::size_t repeated = 0;        // left out: what the map has twice in one place
  std::size_t long_ways = 0;       // left out: of more nodes than a reader's limit
  std::size_t crowded_ways = 0;    // left out: streets and tracks beyond max_streets_at_node
  std::size_t gone = 0;  // left out: what is gone or not built yet (lifecycle.h), lamps excepted
  // The rectangle round what the files say that they hold, where all of them do. Ways reach beyond.
  std::optional<LonLatBox> bounds;
  std::vector<std::string> remarks;  // of the server that made the file
};

/// Returns what of the files is not in `map`, by reason, for reports; also reasons that no element
/// has.
inline std::map<std::string, std::size_t> count_skipped(const OsmData& map) {
  return {{"missing nodes", map.missing_nodes},
          {"bad coordinates", map.bad_coordinates},
          {"duplicates", map.duplicates},
          {"drawn twice in one place", map.repeated},
          {"lamps that are relations without a place", map.lamp_relations},
          {"ridges and edges of roofs", map.roof_lines},
          {"older versions", map.old_versions},
          {"ways of too many nodes", map.long_ways},
          {"gone or not built yet", map.gone},
          {"streets or tracks beyond 64 in one place", map.crowded_ways}};
}

}  // namespace nightcity::osm
