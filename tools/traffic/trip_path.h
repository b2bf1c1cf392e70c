// A route as one smooth way: its links end to end, with the pulling out from the kerb and to it.
#pragma once

#include <vector>

#include "tools/traffic/link_network.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

class TripPath {
 public:
  /// Refers to the network and the route.
  TripPath(const LinkNetwork& network, const TripPlan& plan);

  /// Of the vehicle's middle, `distance_m` from the start of the first link: E, N, H and d point / d
  /// distance.
  Curve::Place at(double distance_m) const;
  double length() const { return starts_.back(); }

 private:
  struct Aside {
    double shift, slope;
  };
  Aside aside(double distance_m) const;

  const LinkNetwork& network_;
  const TripPlan& plan_;
  std::vector<double> starts_;  // of each link, and the end
};

}  // namespace nightcity::traffic
