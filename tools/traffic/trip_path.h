// The path of a trip as one smooth curve: its links end to end, with pulling out from the kerb and
// back to it.
#pragma once

#include <vector>

#include "tools/traffic/link_network.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

class TripPath {
 public:
  /// Keeps references to the network and the plan.
  TripPath(const LinkNetwork& network, const TripPlan& plan);

  /// Returns where the vehicle's middle is at `distance_m` from the start of the first link: the
  /// point (E, N, H) and its derivative by the distance.
  Curve::Place at(double distance_m) const;
  double length() const { return starts_.back(); }

 private:
  // A shift to the right and the rise of the ground there, and their derivatives.
  struct Aside {
    double shift, slope, rise, rise_slope;
  };
  // Shifts by shares of what the vehicle is aside where it is parked.
  static void add(double aside_m, double rise_m, double share, double share_slope, Aside& sum);
  Aside aside(double distance_m) const;

  const LinkNetwork& network_;
  const TripPlan& plan_;
  std::vector<double> starts_;  // of each link, and the end of the last
  // The vehicle stands so much higher than its lane where it is parked.
  double start_rise_m_ = 0, end_rise_m_ = 0;
};

}  // namespace nightcity::traffic
