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

std::string tag(const osm::OsmWay& way, const char* key) {
  const auto found = way.tags.find(key);
  return found == way.tags.end() ? std::string() : osm::normalise_tag(found->second);
}

bool one_of(const std::string& value, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

}  // namespace

std::string why_unlit(const osm::OsmWay& way, lights::LitTag::Kind lit) {
  const std::string highway = tag(way, "highway");
  if (lit == lights::LitTag::Kind::dark) return "lit=no";
  if (!one_of(tag(way, "tunnel"), {"", "no"}) || !one_of(tag(way, "covered"), {"", "no"}) ||
      !one_of(tag(way, "indoor"), {"", "no"}) || highway == "corridor" ||
      tag(way, "layer").starts_with("_"))
    return "tunnel or under cover";
  if (osm::is_out_of_use(way.tags, today())) return "disused";
  if (osm::says_area(way.tags)) return "square mapped as an area";
  if (one_of(tag(way, "footway"), {"sidewalk", "crossing", "traffic_island", "access_aisle"}) ||
      one_of(tag(way, "cycleway"), {"crossing", "sidewalk", "sidepath"}) ||
      one_of(tag(way, "path"), {"crossing", "sidewalk"}) || tag(way, "is_sidepath") == "yes")
    return "crossing or pavement beside a street";
  if (lit != lights::LitTag::Kind::unknown) return {};
  // Without a tag, towns light streets with houses or through traffic: few junctions of motorways,
  // no paths, and service roads only if they are more than a driveway.
  const roads::RoadClass* road_class = roads::find_road_class(highway);
  if (!road_class) return "unlit by class";
  if (one_of(tag(way, "access"), {"private", "no"})) return "private";
  const bool street = road_class->tier != roads::RoadTier::path || highway == "pedestrian";
  const bool way_in = highway == "service" && !one_of(tag(way, "service"), {"", "alley", "bus"});
  if (!street || way_in || highway.starts_with("motorway") || highway.starts_with("trunk"))
    return "unlit by class";
  return {};
}

}  // namespace nightcity::layout
