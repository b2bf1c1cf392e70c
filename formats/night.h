// What changes during a night, as it lies in city.lights, in memory and on the GPU: schedules of lights, and
// vehicles on their ways. Included by C++ and GLSL (scalar block layout). Little-endian, no padding. Times
// are seconds since noon (local civil time) of the day on which the night begins, so that a night is one
// stretch of numbers.
#ifndef NIGHTCITY_FORMATS_NIGHT_H
#define NIGHTCITY_FORMATS_NIGHT_H

#include "formats/light.h"

#ifdef __cplusplus
namespace nightcity {

/// Lights are lit from 17:00 to 07:00, in seconds since noon.
constexpr int night_begin_s = 5 * 3600, night_end_s = 19 * 3600;
#endif

// A light's night: switch times first .. first + count, seconds since noon, strictly ascending, below 86,400.
// The light is off at noon and changes state at each: it shines at time t where the number of switch times <=
// t is odd.
struct Schedule {
  uint first;
  uint count;
};

// A kind of vehicle. Vehicle frame: x forward, y up, z to the right, origin on the road below the middle.
struct VehicleKind {
  vec3 half_size;  // of the body's box, m; its centre is half_size.y above the road
  uint first_light;
  uint
      light_count;  // entries first_light .. first_light + light_count of the vehicle lights (at most
                    // VEHICLE_LIGHTS)
  uint pad[3];
};
#define VEHICLE_LIGHTS 8  // a vehicle may carry, at most

// A vehicle's light is a Light in the vehicle frame whose `schedule` says when it shines, and whose `id` is
// its family (LightFamily in light_file.h).
#define VEHICLE_LIGHT_ALWAYS 0u
#define VEHICLE_LIGHT_BRAKING 1u

// One vehicle's drive, repeated every traffic cycle: it is on the road at time t where
// u = (t - start_s) mod cycle_s < time_s of its last knot, and its drive began (at t - u) when the hour's
// density was above `rank`. So nothing vanishes on its way.
struct Trip {
  uint first_knot;
  uint knot_count;  // >= 2
  float start_s;    // in [0, cycle_s)
  float rank;       // in [0, 1)
  uint vehicle;     // kind of vehicle
  uint id;          // stable identity
  uint pad[2];
};

// A moment of a drive. Between knots position is the cubic Hermite curve of positions and velocities, heading
// goes linearly the short way round, and the vehicle brakes where the earlier knot says so.
struct TripKnot {
  vec3 position;  // model space, m: the vehicle frame's origin
  float time_s;   // since the drive's start; 0 first, strictly ascending, the last at most cycle_s
  vec3 velocity;  // m/s
  uint
      pose;  // bits 0-15 yaw, from east towards north: turns * 65536; 16-23 pitch (nose up), signed, 1/256
             // rad; 24 braking
};
#define KNOT_BRAKING 0x01000000u

// The whole traffic's clockwork.
struct TrafficCycle {
  float cycle_s;  // above 0, at most 86,400
  uint pad;
  float density
      [24];  // share of all trips on the road, in [0, 1], at noon, 13:00 ... 11:00; linear between
};

#ifdef __cplusplus
static_assert(sizeof(Schedule) == 8 && sizeof(VehicleKind) == 32 && sizeof(Trip) == 32);
static_assert(sizeof(TripKnot) == 32 && sizeof(TrafficCycle) == 104);
}  // namespace nightcity
#endif

#endif
