// The lamps of vehicles: light distributions after UN Regulations 112 (dipped beam, class B) and 7
// (rear and stop lamps).
#pragma once

#include <vector>

#include "formats/light_file.h"
#include "tools/lights/photometry.h"
#include "tools/traffic/country.h"
#include "tools/traffic/vehicle_types.h"

namespace nightcity::traffic {

/// Returns the intensity of a dipped beam in cd, h degrees to the right of and v degrees above the
/// lamp's axis, for traffic on the right; on the left it is mirrored (h becomes -h). The model has
/// two lobes below a cut-off at 0.57 degrees (1 %) with the 15-degree kink, and a faint glow above
/// it that lights signs.
double low_beam_cd(double h_degrees, double v_degrees);

/// Returns the beam on a grid round its axis: C = 0 to the right, C = 90 down (light.h, with axis
/// x and tangent z of the vehicle frame). The grid resolves the cut-off; beyond 40 degrees the
/// beam is dark.
lights::Photometry low_beam(Side side);

/// Returns the flux of the model in lumen.
double low_beam_flux_lm();

/// Returns the distribution of rear and stop lamps, symmetric about the axis, for a peak of one
/// candela.
lights::Photometry signal_beam();
constexpr double tail_lamp_cd = 8;    // Regulation 7: 4 to 17 on the axis
constexpr double brake_lamp_cd = 90;  // 60 to 260
constexpr double headlamp_radius_m = 0.05, signal_radius_m = 0.04;

struct VehicleLamps {
  std::vector<VehicleKind> kinds;  // parallel to vehicle_types
  std::vector<Light> lights;
};

/// Makes the lamps of every type in its vehicle frame, just outside the body's ends, so that the
/// body does not block them.
VehicleLamps make_vehicle_lamps(Side side, lights::ProfileTable& profiles);

}  // namespace nightcity::traffic
