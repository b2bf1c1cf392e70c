// The types of vehicles: sizes, driving behaviour and lamps. The sources are in vehicle_types.cpp.
#pragma once

#include <array>
#include <cstddef>

namespace nightcity::traffic {

enum class Shape { car, van, bus, motorcycle, lorry };

struct VehicleType {
  const char* name;
  Shape shape;
  double length_m, width_m, height_m;
  double share;         // of the traffic on a main road
  bool large;           // drives only on classes of road for large vehicles
  double acceleration;  // comfortable, m/s2
  // Least and greatest share of the speed limit (and of the comfortable speed in bends) that
  // drivers keep.
  double speed_factor[2];
  double headlamp_height_m, headlamp_apart_m;  // apart 0: one headlamp
  double headlamp_cct_k;
  double tail_lamp_height_m;
  float paint[3];  // linear reflectance
};

constexpr std::size_t vehicle_type_count = 6;
extern const std::array<VehicleType, vehicle_type_count> vehicle_types;

}  // namespace nightcity::traffic
