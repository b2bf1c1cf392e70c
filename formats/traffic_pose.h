// Where a vehicle is at a moment: the one meaning of the traffic records of night.h. Shared by what writes
// them, by what shows one moment, and by the tests of the renderer's own evaluation.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>

#include "formats/light_file.h"

namespace nightcity {

struct VehiclePose {
  glm::dvec3 position{0};  // model space, m: the vehicle frame's origin
  glm::dvec3 velocity{0};  // m/s
  double yaw = 0;          // radians, from east towards north
  double pitch = 0;        // radians, nose up
  bool braking = false;
};

/// Share of the trips that are on the road, t seconds since noon; any t.
double density_at(const TrafficCycle& cycle, double t);

/// Pose u seconds after the drive's start; u is clamped to the drive. `knots` are the trip's own.
VehiclePose pose_on_drive(std::span<const TripKnot> knots, double u);

/// Seconds since its drive began where the trip is on the road at time t (seconds since noon); empty where it
/// is not.
std::optional<double> on_drive_at(const TrafficContent& traffic, const Trip& trip, double t);

/// Pose at time t (seconds since noon); empty where the trip is not on the road. A pure function of its
/// arguments: the same at t whatever was asked before.
std::optional<VehiclePose> pose_at(const TrafficContent& traffic, const Trip& trip, double t);

/// Vehicle frame (x forward, y up, z right) to model space.
glm::dmat4 to_model(const VehiclePose& pose);

}  // namespace nightcity
