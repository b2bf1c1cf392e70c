#include "tools/roads/road_class.h"

#include <array>

namespace nightcity::roads {
namespace {

// Sources of the columns:
// - Rank: OSM's own order of importance.
// - Lanes: OSM wiki, "Key:lanes": two each way on motorways and trunk roads, one each way below.
// - Lane widths: the basic lane widths of the German guidelines for cross-sections (RAS-Q, EAHV),
//   by what a road is for: 3.75 m at 100 km/h and more, 3.50 m without frontage, 3.25 m for
//   through roads with frontage, 3.00 m for distributor roads, 2.75 m where people live, 2.50 m at
//   walking pace. Two lanes of 3.25 m are the 6.50 m of RASt 06 for roads with buses, four of them
//   its 13.00 m.
// - Single lanes: RASt 06 gives a one-way carriageway 4.25 m on main roads, 3.50 m on access roads
//   and 3.00 m on drives for residents; RAA 2008 gives a slip road 6.00 m (cross-section Q 1).
// - Shoulders: a carriageway of RAA 2008, RQ 31, is 12.00 m wide: two lanes of 3.75 m, a hard
//   shoulder of 3.00 m, two edge strips of 0.75 m. One of RAL 2012, RQ 21, is 7.75 m wide.
// - Pavements: 2.50 m (RASt 06, 6.1.6). Roads of towns have them and kerbs; those between towns
//   have verges; living streets are level (RASt 06, mixed traffic).
// - Paths: footways 2.50 m (RASt 06, 6.1.6), two-way cycle tracks 2.50 m (ERA 2010), farm tracks
//   3.00 m (DWA-A 904). A path is as wide as its one lane.
constexpr std::array<RoadClass, 25> classes = {{
    {"motorway", RoadTier::main, 9, 4, 3.75, 8.25, 4.50, SpeedLimit::motorway, true, 0.00, false},
    {"motorway_link", RoadTier::main, 8, 2, 3.50, 6.00, 0.00, SpeedLimit::ramp, true, 0.00, false},
    {"trunk", RoadTier::main, 8, 4, 3.50, 4.25, 0.75, SpeedLimit::trunk, false, 0.00, false},
    {"trunk_link", RoadTier::main, 7, 2, 3.50, 6.00, 0.00, SpeedLimit::ramp, false, 0.00, false},
    {"primary", RoadTier::main, 7, 2, 3.25, 4.25, 0.00, SpeedLimit::main, false, 2.50, true},
    {"primary_link", RoadTier::main, 6, 2, 3.25, 4.25, 0.00, SpeedLimit::main, false, 2.50, true},
    {"secondary", RoadTier::main, 6, 2, 3.25, 4.25, 0.00, SpeedLimit::main, false, 2.50, true},
    {"secondary_link", RoadTier::main, 5, 2, 3.25, 4.25, 0.00, SpeedLimit::main, false, 2.50, true},
    {"tertiary", RoadTier::local, 5, 2, 3.00, 3.50, 0.00, SpeedLimit::main, false, 2.50, true},
    {"tertiary_link", RoadTier::local, 4, 2, 3.00, 3.50, 0.00, SpeedLimit::residential, false, 2.50,
     true},
    {"unclassified", RoadTier::local, 4, 2, 3.00, 3.50, 0.00, SpeedLimit::residential, false, 0.00,
     true},
    {"residential", RoadTier::local, 3, 2, 2.75, 3.50, 0.00, SpeedLimit::residential, false, 2.50,
     true},
    {"road", RoadTier::local, 3, 2, 2.75, 3.50, 0.00, SpeedLimit::residential, false, 0.00, true},
    {"living_street", RoadTier::local, 2, 2, 2.50, 3.00, 0.00, SpeedLimit::walking, false, 0.00,
     false},
    {"service", RoadTier::local, 1, 2, 2.50, 3.00, 0.00, SpeedLimit::service, false, 0.00, true},
    {"busway", RoadTier::main, 4, 2, 3.25, 4.25, 0.00, SpeedLimit::main, false, 0.00, true},
    {"pedestrian", RoadTier::path, 0, 1, 7.00, 7.00, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"footway", RoadTier::path, 0, 1, 2.50, 2.50, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"path", RoadTier::path, 0, 1, 2.00, 2.00, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"steps", RoadTier::path, 0, 1, 2.50, 2.50, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"cycleway", RoadTier::path, 0, 1, 2.50, 2.50, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"bridleway", RoadTier::path, 0, 1, 2.50, 2.50, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"track", RoadTier::path, 0, 1, 3.00, 3.00, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"platform", RoadTier::path, 0, 1, 3.00, 3.00, 0.00, SpeedLimit::walking, false, 0.00, false},
    {"corridor", RoadTier::path, 0, 1, 2.50, 2.50, 0.00, SpeedLimit::walking, false, 0.00, false},
}};

}  // namespace

std::span<const RoadClass> road_classes() {
  return classes;
}

const RoadClass* find_road_class(std::string_view highway) {
  for (const RoadClass& row : classes)
    if (row.highway == highway) return &row;
  const std::string_view main = main_highway(highway);
  return main == highway ? nullptr : find_road_class(main);
}

std::string_view main_highway(std::string_view highway) {
  constexpr std::string_view link = "_link";
  if (highway.ends_with(link)) highway.remove_suffix(link.size());
  return highway;
}

const char* guess_highway(double carriageway_m) {
  // RASt 06 by width of carriageway: lanes of 3.25 m and more on main streets, 6.5 m on distributor
  // roads with buses, 4.5 to 5.5 m where people live, less where two cars do not pass.
  if (carriageway_m < 4) return "service";
  if (carriageway_m < 6.3) return "residential";
  if (carriageway_m < 8) return "tertiary";
  if (carriageway_m < 12) return "secondary";
  return "primary";
}

}  // namespace nightcity::roads
