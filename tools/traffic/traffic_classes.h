// The traffic on each class of road: how many vehicles, which ones and when. The classes themselves
// are in tools/roads/road_class.h. Sources stand beside the rows in traffic_classes.cpp.
#pragma once

#include <array>
#include <string_view>

namespace nightcity::traffic {

struct TrafficClass {
  const char* highway;         // value of the OSM tag
  double density_per_km_lane;  // vehicles at table_hour
  bool large_vehicles;         // buses and lorries drive here
  bool parking;                // trips may start and end at its kerb
};

/// Returns the row of a normalised highway value; null where no motor vehicle of the public drives
/// (footway, track, busway, proposed, ...).
const TrafficClass* find_traffic_class(std::string_view highway);

/// Share of the traffic of the day's busiest hour, by hour from noon: index 0 is 12:00, 11 is
/// 23:00, 23 is 11:00.
extern const std::array<float, 24> flow_by_hour;

/// The hour of the day that density_per_km_lane is for.
constexpr int table_hour = 22;

}  // namespace nightcity::traffic
