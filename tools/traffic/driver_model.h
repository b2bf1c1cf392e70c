// The constants of the simulation's driver model: how drivers follow each other and brake.
#pragma once

namespace nightcity::traffic {

/// Intelligent Driver Model (Treiber, Hennecke, Helbing 2000): standstill gap in metres and time
/// headway in seconds; the acceleration depends on the type of vehicle (vehicle_types.h).
constexpr double standstill_gap_m = 2.0, headway_s = 1.3;

/// Deceleration in m/s2 beyond which no vehicle brakes. More than `comfortable_braking` is needed
/// only when somebody cuts in.
constexpr double hardest_braking = 7.0;

/// Length of a simulation step, seconds.
constexpr double step_s = 0.25;

}  // namespace nightcity::traffic
