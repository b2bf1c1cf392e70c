// A route as one smooth way: its links end to end, with the pulling out from the kerb and to it.
#pragma once

#include <vector>

#include "tools/traffic/link_network.h"
#include "tools/traffic/routes.h"

namespace nightcity::traffic {

class RoutePath {
 public:
  /// Refers to the network and the route.
  RoutePath(const LinkNetwork& network, const Route& route);

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
  const Route& route_;
  std::vector<double> starts_;  // of each link, and the end
};

}  // namespace nightcity::traffic
