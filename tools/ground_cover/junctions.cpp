#include "tools/ground_cover/junctions.h"

#include <algorithm>
#include <string_view>

#include "formats/finite.h"

namespace nightcity::ground_cover {

bool is_drivable(const std::optional<roads::Carriageway>& road) {
  return road && road->lanes[0] + road->lanes[1] > 0;
}

Junctions::Junctions(std::span<const osm::OsmWay> ways) {
  for (const osm::OsmWay& way : ways) {
    const auto road = roads::read_carriageway(way.tags);
    if (!is_drivable(road)) continue;
    const bool is_entrance = std::string_view(road->road_class->highway) == "service";
    for (std::size_t i = 0; i < way.lon_lat.size(); ++i) {
      if (!finite(way.lon_lat[i])) continue;
      const bool at_end = i == 0 || i + 1 == way.lon_lat.size();
      arms_[{way.lon_lat[i].x, way.lon_lat[i].y}].push_back(
          {&way, road->width_m / 2, is_entrance, at_end ? 1 : 2});
    }
  }
}

bool Junctions::holds(const glm::dvec2& lon_lat) const {
  const auto found = finite(lon_lat) ? arms_.find({lon_lat.x, lon_lat.y}) : arms_.end();
  if (found == arms_.end()) return false;
  int count = 0;
  for (const Arm& arm : found->second) count += arm.count;
  return count > 2;
}

double Junctions::find_reach_m(const glm::dvec2& lon_lat, const osm::OsmWay& way,
                               double clear_m) const {
  if (!holds(lon_lat)) return 0;
  double reach_m = 0;
  for (const Arm& arm : arms_.at({lon_lat.x, lon_lat.y}))
    if (arm.way != &way) reach_m = std::max(reach_m, arm.half_m + (arm.is_entrance ? 0 : clear_m));
  return reach_m;
}

}  // namespace nightcity::ground_cover
