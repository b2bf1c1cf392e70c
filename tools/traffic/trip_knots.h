// A drive as few knots: what the light file keeps of it.
#pragma once

#include <vector>

#include "formats/georeference.h"
#include "formats/night.h"
#include "tools/traffic/simulation.h"
#include "tools/traffic/trip_path.h"

namespace nightcity::traffic {

/// How far the curve through the knots may leave the drive.
struct KnotTolerance {
  double position_m = 0.04;
  double heading_degrees = 1.0;
};

struct KnotError {
  double position_m = 0, heading_degrees = 0;  // the worst met
};

/// As few knots as the tolerance allows (greedily: each as late as may be). Braking from the drive's own
/// deceleration. Empty for a drive of less than two seconds or one that goes nowhere.
std::vector<TripKnot> make_knots(const TripPath& path, const DrivenTrip& trip,
                                 const Georeference& georeference, const KnotTolerance& tolerance,
                                 KnotError& worst);

}  // namespace nightcity::traffic
