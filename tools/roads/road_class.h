// The one table of road classes: what a value of OSM's `highway` tag says about a road that
// carries no further tags. What lamps make of a class is in tools/lights/lamp_defaults.h,
// what traffic makes of it in tools/traffic/traffic_classes.h. The sources stand beside the
// rows in road_class.cpp.
#pragma once

#include <span>
#include <string_view>

namespace nightcity::roads {

/// The importance of a road. Old lamp types came in three sizes, one for each tier.
enum class RoadTier { main = 0, local = 1, path = 2 };

/// The kind of speed limit where none is signed; tools/traffic/country.h has the limits of each
/// country.
enum class SpeedLimit { walking, service, ramp, residential, main, trunk, motorway };

/// Height of a kerb, m: the usual raised kerb of RASt 06 (10 to 15 cm).
constexpr double kerb_m = 0.12;
/// Width of a pavement, m (RASt 06, 6.1.6: 2.50 m for two people that meet).
constexpr double pavement_m = 2.50;

struct RoadClass {
  const char* highway;  // value of the OSM tag
  RoadTier tier;
  int rank;       // at a junction the lower rank gives way
  int lanes;      // of a two-way road, both directions together; a one-way road has half of it
  double lane_m;  // width of a lane
  double single_lane_m;  // width of a carriageway that has one lane only
  double shoulder_m;     // edge strips and hard shoulder of a carriageway, both sides together
  SpeedLimit limit;
  bool one_way;       // where no tag says otherwise
  double pavement_m;  // width of the pavement on each side where no tag says otherwise; 0: none
  bool kerbed;        // the carriageway lies below its sides, by kerb_m
};

/// Returns all rows.
std::span<const RoadClass> road_classes();

/// Returns the row of a normalised highway value; null where there is no road that people use
/// (proposed, construction, raceway, ...).
const RoadClass* find_road_class(std::string_view highway);

/// Returns the highway value without the "_link" of slip roads: "primary" for "primary_link".
std::string_view main_highway(std::string_view highway);

/// Returns the highway value of a road of which nothing is known but its carriageway's width in
/// metres.
const char* guess_highway(double carriageway_m);

}  // namespace nightcity::roads
