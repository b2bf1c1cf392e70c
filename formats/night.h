// Records of what changes during a night: schedules of lights, and traffic. They are the same in
// city.lights, in memory and on the GPU, and are included by C++ and GLSL (scalar block layout;
// little-endian, no padding). Times are seconds since noon (local civil time) of the day on which
// the night begins, so that they ascend through the night.
#ifndef NIGHTCITY_FORMATS_NIGHT_H
#define NIGHTCITY_FORMATS_NIGHT_H

#include "formats/light.h"

#ifdef __cplusplus
namespace nightcity {

/// Lights are lit from 17:00 to 07:00, in seconds since noon.
constexpr int night_begin_s = 5 * 3600, night_end_s = 19 * 3600;
#endif

// The switch times of a light: entries first .. first + count of the switch times, seconds since
// noon, strictly ascending, below 86,400. The light is off at noon and changes its state at each:
// it is on at time t if the number of switch times <= t is odd.
struct Schedule {
  uint first;
  uint count;
};

// A kind of vehicle. Vehicle frame: x forward, y up, z to the right, origin on the road below the
// centre.
struct VehicleKind {
  vec3 half_size;    // of the body's box, m; its centre is half_size.y above the road
  uint first_light;  // entries first_light .. first_light + light_count of the vehicle lights
  uint light_count;  // at most VEHICLE_LIGHTS
  uint pad[3];
};
#define VEHICLE_LIGHTS 8  // bound on the lights of a vehicle

// The light of a vehicle is a Light in the vehicle frame. Its `schedule` is one of these two
// values, and its `id` is its family (LightFamily in light_file.h).
#define VEHICLE_LIGHT_ALWAYS 0u
#define VEHICLE_LIGHT_BRAKING 1u

// The trip of one vehicle, repeated in every traffic cycle. With u = (t - start_s) mod cycle_s, the
// vehicle is on the road at time t if u < time_s of its last knot and the density at the trip's
// start, t - u, was above `rank`. The density at the start decides, so that no vehicle disappears
// during its trip.
struct Trip {
  uint first_knot;
  uint knot_count;  // >= 2
  float start_s;    // in [0, cycle_s)
  float rank;       // in [0, 1)
  uint vehicle;     // kind of vehicle
  uint id;          // stable identity
  uint pad[2];
};

// The pose of a vehicle at one time of its trip. Between two knots, the position is the cubic
// Hermite curve of positions and velocities, yaw and pitch are linear (yaw by the smaller angle),
// and the vehicle brakes if the earlier knot says so.
struct TripKnot {
  vec3 position;  // model space, m: the vehicle frame's origin
  float time_s;   // since the trip's start: 0 first, strictly ascending, the last at most cycle_s
  vec3 velocity;  // m/s
  // Bits 0-15: yaw from east towards north, turns * 65536; 16-23: pitch, nose up, signed, 1/256
  // rad; 24: braking.
  uint pose;
};
#define KNOT_BRAKING 0x01000000u

// All trips share these values.
struct TrafficCycle {
  float cycle_s;  // above 0, at most 86,400
  uint pad;
  // Share of all trips that start, in [0, 1], at noon, 13:00 ... 11:00, linear in between.
  float density[24];
};

#ifdef __cplusplus
static_assert(sizeof(Schedule) == 8 && sizeof(VehicleKind) == 32 && sizeof(Trip) == 32);
static_assert(sizeof(TripKnot) == 32 && sizeof(TrafficCycle) == 104);
}  // namespace nightcity
#endif

#endif
