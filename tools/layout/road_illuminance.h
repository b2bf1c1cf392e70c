// Horizontal illuminance on a road after EN 13201-3: direct light of the luminaires' distributions
// without obstacles, on a plane at the height of the posts' feet.
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
  const lights::Photometry* profile =
      nullptr;  // candela per lumen; null: the same in all directions
};

/// Returns the illuminance in lux at a point of the road: E = I(C, gamma) cos^3(angle from
/// the vertical) / h^2.
double illuminance(const RoadLuminaire& lamp, const glm::dvec2& point);

/// Statistics of the illuminance over a field of points.
struct FieldSummary {
  double average_lx = 0, min_lx = 0;
  double uniformity() const { return average_lx > 0 ? min_lx / average_lx : 0; }
};

enum class Arrangement {
  single,     // all on one side
  staggered,  // alternately on both sides
  opposite,   // in pairs
  central     // hung over the centreline
};
const char* name_of(Arrangement arrangement);

/// An endless straight road with lamps of one kind.
struct LampRow {
  Arrangement arrangement = Arrangement::single;
  double width_m = 0;    // of the carriageway
  double spacing_m = 0;  // along the road from one lamp, or pair, to the next, on either side
  double height_m = 0;
  double overhang_m = 0;  // of the luminous centre over the carriageway; negative: behind the kerb
  double flux_lm = 1;
  const lights::Photometry* profile = nullptr;
};

/// Returns the statistics over one period of the row. The points lie in the middles of their cells:
/// along the road 10 or more, at most 3 m apart, and across it three for each lane (EN 13201-3,
/// 7.1). Lamps count up to 30 mounting heights away, so that the sum agrees with that of an endless
/// row to 0.1 %.
FieldSummary row_illuminance(const LampRow& row);

/// Returns the number of points across a carriageway.
int points_across(double width_m);

}  // namespace nightcity::layout
