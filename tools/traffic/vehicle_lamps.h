// The lamps of vehicles: light distributions after UN Regulations 112 (dipped beam, class B) and 7 (rear and
// stop lamps).
#pragma once

#include <vector>

#include "formats/light_file.h"
#include "tools/lights/photometry.h"
#include "tools/traffic/country.h"
#include "tools/traffic/vehicle_types.h"

namespace nightcity::traffic {

/// Intensity of a dipped beam, cd, towards h degrees to the right of and v degrees above the lamp's axis, for
/// traffic on the right; mirrored (h to -h) for the left. A model: two lobes under a cut-off of 0.57 degrees
/// (1 %) with the 15-degree kink, and a glow above it for signs.
double low_beam_cd(double h_degrees, double v_degrees);

/// The beam on a grid round its axis: C = 0 to the right, C = 90 down (light.h with axis x and tangent z of
/// the vehicle frame). The grid is fine enough for the cut-off; dark beyond 40 degrees.
Photometry low_beam(Side side);

/// Lumen of the model.
double low_beam_flux_lm();

/// Rear and stop lamps: peak on the axis, round it; per candela of the peak.
Photometry signal_beam();
constexpr double tail_lamp_cd = 8;    // Regulation 7: 4 to 17 on the axis
constexpr double brake_lamp_cd = 90;  // 60 to 260
constexpr double headlamp_radius_m = 0.05, signal_radius_m = 0.04;

struct VehicleLamps {
  std::vector<VehicleKind> kinds;  // one for each of vehicle_types
  std::vector<Light> lights;
};

/// Every type's lamps in its vehicle frame, just before and behind the body, so that it does not stand in
/// their way.
VehicleLamps make_vehicle_lamps(Side side, ProfileTable& profiles);

}  // namespace nightcity::traffic
