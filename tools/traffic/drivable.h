// What OSM's tags say about driving on a way: class, directions, lanes, speed, access.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/osm/osm_data.h"
#include "tools/traffic/road_classes.h"

namespace nightcity::traffic {

/// Index 0: along the way as it is drawn; 1: against it.
struct Drivable {
  const RoadClass* road = nullptr;
  int lanes[2] = {1, 1};         // 0: no driving that way
  double speed_m_s[2] = {0, 0};  // limit
  double width_m = 0;            // carriageway
  bool roundabout = false;
  bool structure = false;  // bridge or tunnel: not on the ground
  int layer = 0;

  bool both_ways() const { return lanes[0] > 0 && lanes[1] > 0; }
  double lane_width() const { return width_m / (lanes[0] + lanes[1]); }
  bool operator==(const Drivable&) const = default;
};

/// Nothing, with the reason in `why`, where motor vehicles of the public do not drive.
std::optional<Drivable> read_drivable(const OsmWay& way, const Country& country, std::string& why);

/// "50", "30 mph", "walk", "none", "DE:urban", "DE:zone:30", the first of "50;30": km/h, 3 to 150.
std::optional<double> parse_speed_kmh(std::string_view text);

}  // namespace nightcity::traffic
