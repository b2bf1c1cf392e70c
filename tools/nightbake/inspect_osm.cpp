#include <map>

#include "tools/nightbake/inspect.h"
#include "tools/osm/read_osm.h"

namespace nightcity::nightbake {

Inspection inspect_osm(const std::filesystem::path& file) {
  const osm::OsmData data = osm::read_osm(file);
  Inspection result = make_empty_inspection("osm");
  Bounds bounds, lamp_bounds;
  std::map<std::string, std::size_t> lamp_tags, highways;
  std::size_t lit = 0;
  for (const osm::OsmLampNode& lamp : data.lamps) {
    bounds.add(glm::dvec3(lamp.lon_lat, 0));
    lamp_bounds.add(glm::dvec3(lamp.lon_lat, 0));
    for (const auto& [key, value] : lamp.tags) ++lamp_tags[key];
  }
  for (const osm::OsmWay& way : data.highways) {
    for (const glm::dvec2& p : way.lon_lat) bounds.add(glm::dvec3(p, 0));
    if (const auto kind = way.tags.find("highway"); kind != way.tags.end())
      ++highways[kind->second];
    if (way.tags.contains("lit")) ++lit;
  }
  for (const osm::OsmWay& way : data.buildings)
    for (const glm::dvec2& p : way.lon_lat) bounds.add(glm::dvec3(p, 0));
  result["buildings"] = data.buildings.size();
  result["lights"] = {{"lamp", data.lamps.size()}};
  result["crs"] = "EPSG:4326";
  result["bbox"] = bounds.to_json(2);
  result["skipped"] = osm::count_skipped(data);
  if (!data.remarks.empty()) result["remarks"] = data.remarks;
  result["nodes"] = data.nodes;
  result["ways"] = data.ways;
  result["relations"] = data.relations;
  result["bbox_lamps"] = lamp_bounds.to_json(2);
  result["lamp_tags"] = lamp_tags;
  result["highways"] = highways;
  result["highways_with_lit_tag"] = lit;
  return result;
}

}  // namespace nightcity::nightbake
