// The steps of a map (highway=steps) as flights on the ground.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/steps/flight.h"

namespace nightcity::steps {

struct StepsReport {
  std::size_t ways = 0, flights = 0, treads = 0;
  std::size_t counted_ways = 0;  // whose number of steps is that of their tag step_count
  double mapped_m = 0, built_m = 0;
  std::map<std::string, double> left_out_m;    // by reason: mapped less built
  std::map<std::string, std::size_t> assumed;  // values that no tag gives, or that do not fit
};

struct StepSet {
  std::vector<Flight> flights;
  StepsReport report;
};

/// Finds the flights that stand on the ground within `bounds` (E, N, m): neither in buildings nor
/// on the carriageways of `cover`. A flight rises as far as the ground does from end to end, in
/// steps of equal height: `step_count` says how many, else usual_riser_m. Where the ground rises by
/// less than a step, the way stays a path. No tread lies below the ground under it.
StepSet find_steps(const std::vector<osm::OsmWay>& ways, const ground_cover::Cover& cover,
                   const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                   const place::HeightAt& height_at, const place::InsideBuilding& inside);

}  // namespace nightcity::steps
