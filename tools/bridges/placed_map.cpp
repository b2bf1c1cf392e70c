#include "tools/bridges/placed_map.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "formats/finite.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/line.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"

namespace nightcity::bridges {
namespace {

// Squares and platforms, as areas or lines.
bool is_square(const osm::OsmTags& tags) {
  const std::string highway = osm::find_tag(tags, "highway");
  if (is_bridge(tags) || ground_cover::lies_inside(tags)) return false;
  return highway == "platform" || osm::find_tag(tags, "railway") == "platform" ||
         (!highway.empty() && osm::says_area(tags));
}

bool leads_up(const osm::OsmTags& tags) {
  const std::string highway = osm::find_tag(tags, "highway");
  return highway == "steps" || highway == "elevator" || highway == "corridor";
}

void note_ground(const osm::OsmWay& way, Carried kind, PlacedMap& placed) {
  std::set<NodeKey>& nodes =
      leads_up(way.tags) ? placed.stairs : placed.ground.of_kind[static_cast<std::size_t>(kind)];
  for (const glm::dvec2& lon_lat : way.lon_lat)
    if (finite(lon_lat)) nodes.insert(to_key(lon_lat));
}

// Ways of one line come in the order of their tags, and of the same tags in that of their ids.
bool comes_first(const PlacedWay& a, const PlacedWay& b) {
  if (comes_before_either_way(a.line, b.line)) return true;
  if (comes_before_either_way(b.line, a.line)) return false;
  return std::tie(a.way->tags, a.way->id) < std::tie(b.way->tags, b.way->id);
}

}  // namespace

PlacedMap place_map(const BridgeMap& map, const place::LonLatToFrame& to_frame) {
  PlacedMap placed;
  for (const auto& list : {map.highways, map.railways})
    for (const osm::OsmWay& way : list) {
      const auto kind = find_carried(way.tags);
      if (kind && !is_bridge(way.tags)) note_ground(way, *kind, placed);
      if (is_square(way.tags)) note_ground(way, Carried::path, placed);
      if (!kind) continue;
      PlacedWay one = place_way(way, *kind, to_frame);
      if (one.line.size() > 1) placed.ways.push_back(std::move(one));
    }
  std::stable_sort(placed.ways.begin(), placed.ways.end(), comes_first);
  // A track in a street is in both lists.
  const auto last = std::unique(placed.ways.begin(), placed.ways.end(),
                                [](const PlacedWay& a, const PlacedWay& b) {
                                  return a.way->id == b.way->id && a.way->lon_lat == b.way->lon_lat;
                                });
  placed.ways.erase(last, placed.ways.end());
  for (const PlacedWay& way : placed.ways)
    if (is_bridge(way.way->tags)) placed.bridges.push_back(way);
  return placed;
}

}  // namespace nightcity::bridges
