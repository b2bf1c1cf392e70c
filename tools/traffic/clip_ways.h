// Ways that end where the model's ground ends.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::traffic {

struct ClippedWays {
  std::vector<osm::OsmWay> ways;  // parts of a way keep its id and tags
  /// Ends that come from cutting, in OSM's units of 1e-7 degrees.
  std::set<std::pair<std::int64_t, std::int64_t>> cuts;
};

std::pair<std::int64_t, std::int64_t> osm_units(const glm::dvec2& lon_lat);

/// Appends to `result` the parts of `way` with ground below them, sampled every `step_m` metres. A
/// gap shorter than a step goes unnoticed; under a bridge that is wanted.
void clip_way(const osm::OsmWay& way, const place::LonLatToFrame& to_frame,
              const place::HeightAt& height_at, double step_m, ClippedWays& result);

}  // namespace nightcity::traffic
