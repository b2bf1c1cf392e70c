// Ways cut off where the model's ground ends.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::traffic {

struct ClippedWays {
  std::vector<OsmWay> ways;  // parts of a way keep its id and tags
  /// Ends that the cutting made, in OSM's units of 1e-7 degrees.
  std::set<std::pair<std::int64_t, std::int64_t>> cuts;
};

std::pair<std::int64_t, std::int64_t> osm_units(const glm::dvec2& lon_lat);

/// Keeps what of `way` has ground below it, looking every `step_m`; appends to `result`. Ground that is
/// missing under less than a step goes unnoticed, as under a bridge it may.
void clip_way(const OsmWay& way, const LonLatToFrame& to_frame, const HeightAt& height_at,
              double step_m, ClippedWays& result);

}  // namespace nightcity::traffic
