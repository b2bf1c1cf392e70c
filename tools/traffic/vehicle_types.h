// The kinds of vehicles that drive at night: sizes, manners and lamps. Sources stand in vehicle_types.cpp.
#pragma once

#include <array>
#include <cstddef>

namespace nightcity::traffic {

enum class Shape { vehicle, van, bus, motorcycle, lorry };

struct VehicleType {
  const char* name;
  Shape shape;
  double length_m, width_m, height_m;
  double share;         // of the traffic on a main road
  bool large;           // keeps to the classes of road that large vehicles use
  double acceleration;  // comfortable, m/s2
  double speed_factor
      [2];  // of the limit (and the comfortable speed in bends) that its drivers keep, from - to
  double headlamp_height_m, headlamp_apart_m;  // apart 0: one headlamp
  double headlamp_cct_k;
  double tail_lamp_height_m;
  float paint[3];  // linear reflectance
};

constexpr std::size_t vehicle_type_count = 6;
extern const std::array<VehicleType, vehicle_type_count> vehicle_types;

}  // namespace nightcity::traffic
