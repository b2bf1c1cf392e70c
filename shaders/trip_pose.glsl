// The position of a trip's vehicle at a given time (formats/night.h).
// formats/traffic_pose.h is the same in C++.

struct Pose {
  vec3 position;  // of the vehicle frame's origin, model space
  mat3 axes;      // columns: forward, up, right
  bool on_road;
  bool braking;
};

// Returns the share of all trips that are on the road at a time since noon.
float traffic_density(float time_s) {
  float hour = time_s / 3600.0;
  hour -= 24.0 * floor(hour / 24.0);
  const uint whole = min(uint(hour), 23u);
  return mix(SCENE.traffic.cycle.density[whole], SCENE.traffic.cycle.density[(whole + 1u) % 24u],
             hour - float(whole));
}

float yaw_turns(uint pose) { return float(pose & 0xFFFFu) / 65536.0; }
float pitch_of(uint pose) { return float(int(pose << 8u) >> 24) / 256.0; }

// Returns the pose at `cycle_time_s` within the traffic's cycle; `time_s` since noon decides
// whether the trip is driven.
Pose trip_pose(uint index, float cycle_time_s, float time_s) {
  const Trip trip = SCENE.traffic.trips.at[index];
  const float cycle = SCENE.traffic.cycle.cycle_s;
  float u = cycle_time_s - trip.start_s;
  if (u < 0.0) u += cycle;
  Pose pose;
  pose.position = vec3(0.0);
  pose.axes = mat3(1.0);
  pose.braking = false;
  uint low = trip.first_knot, high = trip.first_knot + trip.knot_count - 1u;
  pose.on_road = u < SCENE.traffic.knots.at[high].time_s && traffic_density(time_s - u) > trip.rank;
  if (!pose.on_road) return pose;
  while (high - low > 1u) {  // the knots around u
    const uint middle = (low + high) / 2u;
    if (SCENE.traffic.knots.at[middle].time_s <= u) low = middle; else high = middle;
  }
  const TripKnot a = SCENE.traffic.knots.at[low];
  const TripKnot b = SCENE.traffic.knots.at[high];
  const float span = b.time_s - a.time_s;
  const float s = clamp((u - a.time_s) / span, 0.0, 1.0);
  const float s2 = s * s, s3 = s2 * s;
  // A Hermite curve relative to `a`, so that sums of large coordinates cost no precision.
  pose.position = a.position + (b.position - a.position) * (3.0 * s2 - 2.0 * s3) +
                  (a.velocity * (s3 - 2.0 * s2 + s) + b.velocity * (s3 - s2)) * span;
  float turn = yaw_turns(b.pose) - yaw_turns(a.pose);
  turn -= round(turn);  // the short way round
  const float yaw = 6.28318530718 * (yaw_turns(a.pose) + turn * s);
  const float pitch = mix(pitch_of(a.pose), pitch_of(b.pose), s);
  const vec3 forward = vec3(cos(yaw) * cos(pitch), sin(pitch), -sin(yaw) * cos(pitch));
  const vec3 right = vec3(sin(yaw), 0.0, cos(yaw));
  pose.axes = mat3(forward, cross(right, forward), right);
  pose.braking = (a.pose & KNOT_BRAKING) != 0u;
  return pose;
}
