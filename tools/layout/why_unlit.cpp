#include "tools/layout/why_unlit.h"

#include <algorithm>
#include <initializer_list>

#include "tools/osm/lifecycle.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/road_class.h"
#include "tools/today.h"

namespace nightcity::layout {
namespace {

bool one_of(const std::string& value, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

}  // namespace

std::string why_unlit(const osm::OsmWay& way, lights::LitTag::Kind lit) {
  const std::string highway = osm::find_tag(way.tags, "highway");
  if (lit == lights::LitTag::Kind::dark) return "lit=no";
  if (osm::is_tagged(way.tags, "tunnel") || osm::is_tagged(way.tags, "covered") ||
      osm::is_tagged(way.tags, "indoor") || highway == "corridor" ||
      osm::find_tag(way.tags, "layer").starts_with("_"))
    return "tunnel or under cover";
  if (osm::is_out_of_use(way.tags, today())) return "disused";
  if (osm::says_area(way.tags)) return "square mapped as an area";
  if (one_of(osm::find_tag(way.tags, "footway"),
             {"sidewalk", "crossing", "traffic_island", "access_aisle"}) ||
      one_of(osm::find_tag(way.tags, "cycleway"), {"crossing", "sidewalk", "sidepath"}) ||
      one_of(osm::find_tag(way.tags, "path"), {"crossing", "sidewalk"}) ||
      osm::find_tag(way.tags, "is_sidepath") == "yes")
    return "crossing or pavement beside a street";
  if (lit != lights::LitTag::Kind::unknown) return {};
  // Without a tag, towns light streets with houses or through traffic: few junctions of motorways,
  // no paths, and service roads only if they are more than a driveway.
  const roads::RoadClass* road_class = roads::find_road_class(highway);
  if (!road_class) return "unlit by class";
  if (one_of(osm::find_tag(way.tags, "access"), {"private", "no"})) return "private";
  const bool street = road_class->tier != roads::RoadTier::path || highway == "pedestrian";
  const bool way_in =
      highway == "service" && !one_of(osm::find_tag(way.tags, "service"), {"", "alley", "bus"});
  if (!street || way_in || highway.starts_with("motorway") || highway.starts_with("trunk"))
    return "unlit by class";
  return {};
}

}  // namespace nightcity::layout
