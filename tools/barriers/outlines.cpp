#include "tools/barriers/outlines.h"

#include <string_view>

#include "tools/osm/map_areas.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/resolution.h"
#include "tools/place/longitude.h"
#include "tools/today.h"

namespace nightcity::barriers {
namespace {

osm::OsmWay to_way(const std::vector<glm::dvec2>& ring, const osm::OsmTags& tags) {
  osm::OsmWay way{0, {}, tags};
  for (const glm::dvec2& p : ring)  // rounded, so that gates on a ring are found
    way.lon_lat.emplace_back(osm::round_degrees(place::count_on(p.x, 0)), osm::round_degrees(p.y));
  way.lon_lat.push_back(way.lon_lat.front());
  return way;
}

}  // namespace

std::vector<osm::OsmWay> read_outlines(const std::filesystem::path& map, std::size_t max_nodes,
                                       std::set<std::string>& known) {
  std::vector<osm::OsmWay> ways;
  for (const osm::MapArea& area :
       osm::read_map_areas(map, {{"barrier"}, osm::is_barrier, today()}, max_nodes).areas) {
    // Closed ways are barriers already.
    if (!std::string_view(area.id).starts_with("relation/") || !known.insert(area.id).second)
      continue;
    for (const osm::MapRings& rings : area.rings) {
      if (!rings.outer.empty()) ways.push_back(to_way(rings.outer, area.tags));
      for (const auto& hole : rings.holes)
        if (!hole.empty()) ways.push_back(to_way(hole, area.tags));
    }
  }
  return ways;
}

}  // namespace nightcity::barriers
