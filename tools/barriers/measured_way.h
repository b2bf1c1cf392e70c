// A barrier's way in the city's frame, with lengths along it.
#pragma once

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "tools/barriers/openings.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::barriers {

struct MeasuredWay {
  std::vector<glm::dvec2> points;                     // E, N, m; finite
  std::vector<double> at_m;                           // of each point, from the first
  std::vector<std::pair<double, double>> openings_m;  // from, to; in order, apart from each other

  double length_m() const { return at_m.empty() ? 0 : at_m.back(); }
  bool is_closed() const { return points.size() > 3 && points.front() == points.back(); }
  bool is_open_at(double s_m) const;
  /// Returns lengths along a segment from `from_m` to `to_m`, in order, `step_m` apart or less, and
  /// the edges of openings among them. They count from the segment's start.
  std::vector<double> find_cuts(std::size_t segment, double from_m, double to_m,
                                double step_m) const;
};

/// `thickness_m`: of the barrier.
MeasuredWay measure(const osm::OsmWay& way, const place::LonLatToFrame& to_frame,
                    const Openings& openings, double thickness_m = 0);

}  // namespace nightcity::barriers
