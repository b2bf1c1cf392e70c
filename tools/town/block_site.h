// The site of a block's buildings: its parcel, its ground, and what its houses have in common.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/random.h"
#include "tools/town/building_plan.h"

namespace nightcity::town {

/// One side of a quad with its own axes: s along the street, y into the block.
struct Side {
  glm::dvec2 start, along, inward;
  double length;
  glm::dvec2 at(double s, double y) const { return start + along * s + inward * y; }
  double depth_of(const glm::dvec2& p) const;
};
Side side_of(const Quad& quad, std::size_t k);

/// Gathers the plans of one block, in the order of the draws from its random numbers.
struct BlockSite {
  BlockSite(const StreetPlan& streets, const Hills& hills, std::uint64_t seed, int i, int j);

  /// Puts a plan on its ground: the ground surface at the lowest corner, storeys counted from the
  /// mean.
  void stand(BuildingPlan& plan, double storey_m, double plinth_m) const;
  /// Sets the roof and its ridge over a body `depth_m` deep. `pitch_degrees` is for gabled and
  /// hipped roofs alone.
  static void roof_over(BuildingPlan& plan, Roof roof, double depth_m, double pitch_degrees);

  /// Draw the storeys, the use and the year of a house near the centre.
  int core_storeys();
  const char* core_function();
  int old_year();

  const Hills& hills;
  Quad parcel;
  std::array<Side, 4> sides;
  double remoteness;
  Random random;
  std::vector<BuildingPlan> plans;
};

/// Returns a plan with this outline alone; its depth lies to the left of `along` (unit).
BuildingPlan make_rectangle(const glm::dvec2& corner, const glm::dvec2& along, double length,
                            double depth);

}  // namespace nightcity::town
