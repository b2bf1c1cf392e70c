#include "tools/traffic/traffic_classes.h"

namespace nightcity::traffic {
namespace {

// Density is flow over speed. On a main street some 300 vehicles an hour and lane drive at 22:00 (a
// third of the peak's 900; Highway Capacity Manual, urban streets): at 50 km/h they are 6 a km.
// Residential streets see 20 to 30 vehicles an hour: 0.5 a km.
constexpr std::array<TrafficClass, 15> classes = {{
    {"motorway", 8.0, true, false},
    {"motorway_link", 4.0, true, false},
    {"trunk", 6.0, true, false},
    {"trunk_link", 3.0, true, false},
    {"primary", 6.0, true, false},
    {"primary_link", 3.0, true, false},
    {"secondary", 4.0, true, false},
    {"secondary_link", 2.0, true, false},
    {"tertiary", 2.5, true, true},
    {"tertiary_link", 1.2, true, false},
    {"unclassified", 1.0, false, true},
    {"residential", 0.5, false, true},
    {"road", 0.5, false, true},
    {"living_street", 0.2, false, true},
    {"service", 0.2, false, true},
}};

}  // namespace

const TrafficClass* find_traffic_class(std::string_view highway) {
  for (const TrafficClass& row : classes)
    if (row.highway == highway) return &row;
  return nullptr;
}

// The shape of weekday counts on city roads: a third of the day's peak at 22:00, a twentieth at
// 3:00, as in the hourly volumes of UCI's "Metro Interstate Traffic Volume" (MnDOT station 301,
// 2012-2018), rounded by hand. From 6:00 to 20:00 the table keeps the share of 20:00, which is 0.51
// of the peak, and everything is scaled to it. More traffic does not get through junctions without
// signals; and since every hour shows a share of the same trips, the queues of a busier hour would
// stand in the empty streets of the others.
const std::array<float, 24> flow_by_hour = {1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f,
                                            1.00f, 0.84f, 0.69f, 0.45f, 0.25f, 0.16f, 0.12f, 0.12f,
                                            0.25f, 0.84f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f};

}  // namespace nightcity::traffic
