// Horizontal illuminance on a road, as EN 13201-3 computes it: direct light of the luminaires' distributions,
// nothing in the way, the road a plane at the posts' feet.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "tools/lights/photometry.h"

namespace nightcity::layout {

struct RoadLuminaire {
  glm::dvec2 centre{0, 0};  // luminous centre in plan, m
  double height_m = 0;      // above the road
  glm::dvec2 aim{0, 1};     // unit, the C = 0 half-plane
  double tilt_degrees = 0;  // of the axis, from straight down towards `aim`
  double flux_lm = 0;
  const Photometry* profile = nullptr;  // candela per lumen; null = the same to all sides
};

/// Lux at a point of the road: E = I(C, gamma) cos^3 / h^2, the angle from the vertical.
double illuminance(const RoadLuminaire& lamp, const glm::dvec2& point);

/// The values over a field of points.
struct FieldSummary {
  double average_lx = 0, min_lx = 0;
  double uniformity() const { return average_lx > 0 ? min_lx / average_lx : 0; }
};

enum class Arrangement {
  single,     // all on one side
  staggered,  // one side, then the other
  opposite,   // in pairs
  central     // hung over the middle
};
const char* name_of(Arrangement arrangement);

/// An endless straight road with lamps of one kind.
struct LampRow {
  Arrangement arrangement = Arrangement::single;
  double width_m = 0;    // of the carriageway
  double spacing_m = 0;  // from one lamp, or pair, to the next along the road, whichever its side
  double height_m = 0;
  double overhang_m = 0;  // of the luminous centre over the carriageway; negative = behind the kerb
  double flux_lm = 1;
  const Photometry* profile = nullptr;
};

/// Points of the field: 10 or more and at most 3 m apart along one period of the row, three to a lane across
/// (EN 13201-3, 7.1), in the middles of their cells. Lamps count to 30 mounting heights, so that the sum is
/// that of an endless row to 0.1 %.
FieldSummary row_illuminance(const LampRow& row);

/// Points across a carriageway.
int points_across(double width_m);

}  // namespace nightcity::layout
