#include "tools/traffic/country.h"

#include <array>

namespace nightcity::traffic {
namespace {

struct Box {
  double west, south, east, north;
  Country country;
};

// Countries that drive on the left, after Wikipedia's "Left- and right-hand traffic", as boxes;
// the first box that holds the place wins. Speeds: the limits of the national highway codes where
// none is signed.
constexpr Country continental = {"right-hand default", Side::right, 50, 50, 100, 130};
constexpr std::array<Box, 23> boxes = {{
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
    {176.8, -21.0, 180.0, -12.4, {"Fiji", Side::left, 50, 50, 80, 80}},
    {-180.0, -21.0, -178.2, -12.4, {"Fiji", Side::left, 50, 50, 80, 80}},
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

const Country& country_at(const glm::dvec2& lon_lat) {
  for (const Box& box : boxes)
    if (lon_lat.x >= box.west && lon_lat.x <= box.east && lon_lat.y >= box.south &&
        lon_lat.y <= box.north)
      return box.country;
  return continental;
}

double default_speed_kmh(const roads::RoadClass& road, const Country& country) {
  using enum roads::SpeedLimit;
  switch (road.limit) {
    case walking:
      return 7;  // walking pace: StVO annex 3, sign 325.1; the Vienna Convention's sign E,17a
    case service:
      return 20;
    case ramp:
      return 60;
    case residential:
      return country.residential_kmh;
    case main:
      return country.main_kmh;
    case trunk:
      return country.trunk_kmh;
    case motorway:
      break;
  }
  return country.motorway_kmh;
}

}  // namespace nightcity::traffic
