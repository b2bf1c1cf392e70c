// Fits a curve with few knots to a driven trip, for the light file.
#pragma once

#include <vector>

#include "formats/georeference.h"
#include "formats/night.h"
#include "tools/traffic/simulation.h"
#include "tools/traffic/trip_path.h"

namespace nightcity::traffic {

/// The greatest allowed deviation of the curve through the knots from the driven trip.
struct KnotTolerance {
  double position_m = 0.04;
  double heading_degrees = 1.0;
};

struct KnotError {
  double position_m = 0, heading_degrees = 0;  // the greatest deviations
};

/// Returns as few knots as the tolerance allows, chosen greedily: each as late as possible. Braking
/// follows from the deceleration of the trip. Empty for a trip of less than two seconds or less
/// than 5 m.
std::vector<TripKnot> make_knots(const TripPath& path, const DrivenTrip& trip,
                                 const Georeference& georeference, const KnotTolerance& tolerance,
                                 KnotError& worst);

}  // namespace nightcity::traffic
