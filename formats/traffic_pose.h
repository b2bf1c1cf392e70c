// The pose of a vehicle at a given time: the definition of what the traffic records of night.h
// mean. The baker and the tests of the renderer's shader share it.
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

/// The motion between two neighbouring knots of a trip, to be asked at many times.
class KnotStretch {
 public:
  KnotStretch(const TripKnot& a, const TripKnot& b);
  /// Returns the pose `u` seconds after the trip's start, from the time of one knot to that of the
  /// other.
  VehiclePose pose_at(double u) const {
    const double x = (u - begin_) / step_, x2 = x * x, x3 = x2 * x;
    VehiclePose pose;
    pose.position = p0_ * (2 * x3 - 3 * x2 + 1) + v0_ * ((x3 - 2 * x2 + x) * step_) +
                    p1_ * (3 * x2 - 2 * x3) + v1_ * ((x3 - x2) * step_);
    pose.velocity = (p1_ - p0_) * ((6 * x - 6 * x2) / step_) + v0_ * (3 * x2 - 4 * x + 1) +
                    v1_ * (3 * x2 - 2 * x);
    pose.yaw = yaw_ + turn_ * x;
    pose.pitch = pitch_ + rise_ * x;
    pose.braking = braking_;
    return pose;
  }

 private:
  glm::dvec3 p0_, p1_, v0_, v1_;
  double begin_, step_;
  double yaw_, turn_, pitch_, rise_;  // at the first knot, and on the way to the other
  bool braking_;
};

/// Returns the share of trips that start at time t, seconds since noon. t may be of any day.
double density_at(const TrafficCycle& cycle, double t);

/// Returns the pose u seconds after the start of the trip with these knots; u is clamped to the
/// trip.
VehiclePose pose_on_trip(std::span<const TripKnot> knots, double u);

/// Returns the seconds since the trip's start if its vehicle is on the road at time t (seconds
/// since noon), nothing otherwise.
std::optional<double> find_trip_time(const TrafficContent& traffic, const Trip& trip, double t);

/// Returns the pose at time t (seconds since noon), or nothing if the vehicle is not on the road
/// then. Depends on its arguments only, so times may be asked for in any order.
std::optional<VehiclePose> pose_at(const TrafficContent& traffic, const Trip& trip, double t);

/// Returns the transform from the vehicle frame (x forward, y up, z right) to model space.
glm::dmat4 to_model(const VehiclePose& pose);

}  // namespace nightcity
