// Streets as surfaces draped on the ground: carriageways, pavements, junctions and the market
// square.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/town/hills.h"
#include "tools/town/street_plan.h"

namespace nightcity::town {

struct RoadArea {
  int function = 1;  // CityGML TrafficArea function code: 1 driving lane, 2 footpath, 5 square
  /// Triangles, counter-clockwise from above, and upright kerb faces of 4; m from the town's
  /// origin.
  std::vector<city::Ring> rings;
};

struct RoadPlan {
  const char* kind = "road";  // "road", "junction", "pavement", "path": part of the gml:id
  int i = 0, j = 0, axis = 0;
  StreetClass street = StreetClass::residential;
  std::vector<RoadArea> areas;
};

/// A straight stretch between two junctions: its centreline and the kerbs along which lamp posts
/// stand.
struct Stretch {
  glm::dvec2 from, to;      // ends of the part that belongs to no junction
  glm::dvec2 kerb_left[2];  // the left kerb from `from` to `to`
  glm::dvec2 kerb_right[2];
  StreetClass street;
  int i = 0, j = 0, axis = 0;
};

/// Returns the stretch from node (i, j) along a row street (axis 0) or a column street (axis 1).
Stretch find_stretch(const StreetPlan& streets, int i, int j, int axis);

/// Visits every stretch of street, row streets first, in a fixed order; then the paths through the
/// parks.
void for_each_stretch(const StreetPlan& streets, const std::function<void(const Stretch&)>& visit);

/// Visits every surface: stretches with their pavements, junctions, pavement corners, the market
/// square.
void for_each_road(const StreetPlan& streets, const Hills& hills,
                   const std::function<void(const RoadPlan&)>& visit);

}  // namespace nightcity::town
