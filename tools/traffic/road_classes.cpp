#include "tools/traffic/road_classes.h"

#include <string_view>

namespace nightcity::traffic {
namespace {

// Rank by OSM's own order of importance. Lanes and lane widths: OSM wiki "Key:lanes" (two each way on
// motorways and trunks, one each way below) and OSM2World's 3.5 m lane, narrower in streets (RASt
// 06: 3.00-3.25 m, 2.75 m where people live). Density is flow over speed: on a main street at 22 h some 300
// vehicles an hour and lane (a third of the peak's 900, HCM's urban streets) at 50 km/h make 6 a km;
// residential streets see 20-30 an hour, 0.5 a km.
constexpr std::array<RoadClass, 15> classes = {{
    {"motorway", 9, 4, 3.5, 8.0, true, false},
    {"motorway_link", 8, 2, 3.5, 4.0, true, false},
    {"trunk", 8, 4, 3.5, 6.0, true, false},
    {"trunk_link", 7, 2, 3.5, 3.0, true, false},
    {"primary", 7, 2, 3.25, 6.0, true, false},
    {"primary_link", 6, 2, 3.25, 3.0, true, false},
    {"secondary", 6, 2, 3.25, 4.0, true, false},
    {"secondary_link", 5, 2, 3.25, 2.0, true, false},
    {"tertiary", 5, 2, 3.0, 2.5, true, true},
    {"tertiary_link", 4, 2, 3.0, 1.2, true, false},
    {"unclassified", 4, 2, 3.0, 1.0, false, true},
    {"residential", 3, 2, 2.75, 0.5, false, true},
    {"road", 3, 2, 2.75, 0.5, false, true},
    {"living_street", 2, 2, 2.5, 0.2, false, true},
    {"service", 1, 2, 2.5, 0.2, false, true},
}};

struct Box {
  double west, south, east, north;
  Country country;
};

// Left-hand countries after the list of the International Driving Permit's states (Wikipedia "Left- and
// right-hand traffic"), as boxes; the first that holds the place wins. Speeds: national highway codes'
// unsigned limits.
constexpr Country continental = {"right-hand default", Side::right, 50, 50, 100, 130};
constexpr std::array<Box, 21> boxes = {{
    {-5.45, 54.95, -0.5, 61.0, {"Great Britain", Side::left, 48, 48, 97, 113}},
    {-10.8, 51.3, -5.4, 55.5, {"Ireland", Side::left, 50, 50, 100, 120}},
    {-8.7, 49.8, 1.45, 50.9, {"Great Britain", Side::left, 48, 48, 97, 113}},
    {-6.5, 50.9, 1.77, 59.5, {"Great Britain", Side::left, 48, 48, 97, 113}},
    {14.1, 35.7, 14.7, 36.2, {"Malta", Side::left, 50, 50, 80, 80}},
    {32.2, 34.5, 34.7, 35.75, {"Cyprus", Side::left, 50, 50, 80, 100}},
    {128.5, 30.0, 131.0, 34.2, {"Japan", Side::left, 30, 50, 60, 100}},
    {122.9, 24.0, 131.5, 30.0, {"Japan", Side::left, 30, 50, 60, 100}},
    {130.8, 31.0, 146.0, 45.6, {"Japan", Side::left, 30, 50, 60, 100}},
    {113.5, 22.1, 114.5, 22.56, {"Hong Kong and Macao", Side::left, 50, 50, 70, 100}},
    {97.3, 5.6, 105.6, 20.5, {"Thailand", Side::left, 50, 60, 80, 120}},
    {99.6, -11.1, 119.3, 7.4, {"Malaysia, Singapore, Indonesia", Side::left, 50, 50, 70, 90}},
    {119.3, -11.1, 141.0, 2.0, {"Indonesia", Side::left, 30, 50, 80, 100}},
    {110.0, -48.0, 180.0, -8.0, {"Australia and New Zealand", Side::left, 50, 60, 100, 110}},
    {68.0, 6.0, 92.7, 30.5, {"India, Bangladesh, Sri Lanka, Nepal", Side::left, 40, 50, 80, 100}},
    {61.0, 23.5, 75.5, 37.1, {"Pakistan", Side::left, 40, 50, 80, 120}},
    {11.7, -35.0, 41.0, -8.3, {"southern Africa", Side::left, 60, 60, 100, 120}},
    {29.3, -11.8, 42.0, 4.7, {"east Africa", Side::left, 50, 50, 80, 110}},
    {-78.5, 17.6, -76.1, 18.6, {"Jamaica", Side::left, 50, 50, 80, 110}},
    {-125.0, 25.0, -66.9, 49.0, {"United States", Side::right, 40, 56, 88, 105}},
    {5.8, 47.2, 15.1, 55.1, {"Germany", Side::right, 50, 50, 100, 130}},
}};

}  // namespace

const RoadClass* road_class(std::string_view highway) {
  for (const RoadClass& row : classes)
    if (row.highway == highway) return &row;
  return nullptr;
}

const Country& country_at(const glm::dvec2& lon_lat) {
  for (const Box& box : boxes)
    if (lon_lat.x >= box.west && lon_lat.x <= box.east && lon_lat.y >= box.south &&
        lon_lat.y <= box.north)
      return box.country;
  return continental;
}

double default_speed_kmh(const RoadClass& road, const Country& country) {
  const std::string_view highway = road.highway;
  if (highway == "motorway") return country.motorway_kmh;
  if (highway == "trunk") return country.trunk_kmh;
  if (highway == "motorway_link" || highway == "trunk_link") return 60;
  if (highway == "living_street")
    return 7;  // walking pace (StVO annex 3, sign 325.1), as Vienna's E,17a has it
  if (highway == "service") return 20;
  return road.rank >= 5 ? country.main_kmh : country.residential_kmh;
}

// The shape of weekday counts on city roads: a third of the day's peak at 22 h, a twentieth at 3 h, as in the
// hourly volumes of UCI's "Metro Interstate Traffic Volume" (MnDOT station 301, 2012-2018), rounded by hand.
// Held at 20 h's 0.51 of the peak from 6 to 20 h, and scaled to it: more does not pass junctions without
// signals, and queues that a busier hour makes would stand in the others' empty streets, since every hour
// shows a share of the same drives.
const std::array<float, 24> flow_by_hour = {1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f,
                                            1.00f, 0.84f, 0.69f, 0.45f, 0.25f, 0.16f, 0.12f, 0.12f,
                                            0.25f, 0.84f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f, 1.00f};

}  // namespace nightcity::traffic
