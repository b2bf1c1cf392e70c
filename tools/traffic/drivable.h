// Reads the tags of OSM about driving on a way: class, directions, lanes, speed, access.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/osm/osm_data.h"
#include "tools/roads/carriageway.h"
#include "tools/traffic/country.h"
#include "tools/traffic/traffic_classes.h"

namespace nightcity::traffic {

/// A way as a driver sees it. Index 0 of an array: along the way as it is drawn; 1: against it.
struct Drivable {
  const TrafficClass* traffic = nullptr;
  roads::Carriageway carriageway;  // a direction with no lanes is not driven
  double speed_m_s[2] = {0, 0};    // limit
  bool structure = false;          // bridge or tunnel: not on the ground
  bool bridge = false;
  int layer = 0;

  bool both_ways() const { return carriageway.lanes[0] > 0 && carriageway.lanes[1] > 0; }
  bool operator==(const Drivable&) const = default;
};

/// Returns what the tags say about driving on the way. Empty, with the reason in `why`, where motor
/// vehicles of the public do not drive.
std::optional<Drivable> read_drivable(const osm::OsmWay& way, const Country& country,
                                      std::string& why);

/// Returns a speed limit in km/h, 3 to 150: "50", "30 mph", "walk", "none", "DE:urban",
/// "DE:zone:30", the first of "50;30". Empty if the text is no speed.
std::optional<double> parse_speed_kmh(std::string_view text);

}  // namespace nightcity::traffic
