// Streets in metres for the tests of traffic, on a plane or on hills.
#pragma once

#include <cmath>
#include <string>

#include "tools/layout/street_plane.h"
#include "tools/place/site.h"

namespace nightcity::test {

/// Gentle hills with slopes up to 6 %.
inline std::optional<double> hills(const glm::dvec2& p) {
  return 50 + 6 * std::sin(p.x / 100) + 4 * std::cos(p.y / 80);
}

/// Returns a grid of `n` by `n` blocks of `size_m`. The middle lines are main roads, every third
/// residential street is one-way, and the ends run `tail_m` beyond the grid.
inline std::vector<osm::OsmWay> street_grid(int n, double size_m, double tail_m) {
  std::vector<osm::OsmWay> ways;
  for (int axis = 0; axis < 2; ++axis)
    for (int line = 0; line <= n; ++line) {
      std::vector<glm::dvec2> points;
      for (int k = -1; k <= n + 1; ++k) {
        const double along = k < 0 ? -tail_m : k > n ? n * size_m + tail_m : k * size_m;
        const double across = line * size_m;
        points.push_back(axis == 0 ? glm::dvec2(along, across) : glm::dvec2(across, along));
      }
      osm::OsmTags tags = {{"highway", line == n / 2 ? "secondary" : "residential"}};
      if (line % 3 == 2) tags["oneway"] = axis == 0 ? "yes" : "-1";
      ways.push_back(street(100 * axis + line + 1, points, tags));
    }
  return ways;
}

}  // namespace nightcity::test
