// The tables behind the traffic: what drives on which class of road, how fast, how many and when. Sources
// stand beside the rows in road_classes.cpp.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string_view>

namespace nightcity::traffic {

enum class Side { right, left };

struct RoadClass {
  const char*
      highway;    // value of the OSM tag; "_link" classes have rows of their own where they differ
  int rank;       // who gives way: the lower one
  int lanes;      // of a two-way road, both directions together; of a one-way road the half of it
  double lane_m;  // width of a lane
  double density_per_km_lane;  // vehicles at 22 h
  bool large_vehicles;         // buses and lorries come here
  bool parking;                // drives may start and end at its kerb
};

/// The row of a normalised highway value; null where no motor vehicle drives (footway, track, proposed, ...).
const RoadClass* road_class(std::string_view highway);

/// Implicit speed limits and the side of the road of a part of the world.
struct Country {
  const char* name;
  Side side;
  double residential_kmh, main_kmh, trunk_kmh,
      motorway_kmh;  // in towns; trunk and motorway outside them
};

/// Of a place in WGS 84 degrees. Boxes, so wrong within some kilometres of a few borders: the recipe's `side`
/// overrides. Where nothing is known: right, 50 km/h.
const Country& country_at(const glm::dvec2& lon_lat);

/// The speed limit, km/h, that a class has unsigned.
double default_speed_kmh(const RoadClass& road, const Country& country);

/// Share of the day's busiest hour, by hour from noon: index 0 is 12:00, 11 is 23:00, 23 is 11:00.
extern const std::array<float, 24> flow_by_hour;
constexpr int table_hour = 22;  // the hour density_per_km_lane is for

}  // namespace nightcity::traffic
