// A flight of steps between two heights of the ground.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "tools/ground_cover/ground_kind.h"

namespace nightcity::steps {

/// Steps are as high as this where no tag says how many there are, m: 14 to 19 cm outdoors (DIN
/// 18065, table 1), and twice that and a tread is the 63 cm of a stride.
constexpr double usual_riser_m = 0.16;
/// Risers outside this range, m, are not those of the flight that was counted: the ground is not
/// known as well as that.
constexpr double min_riser_m = 0.08, max_riser_m = 0.30;
/// No tread is less deep than this, m (DIN 18065: 21 cm).
constexpr double min_tread_m = 0.21;

/// A flight lies along its line. Each tread is level, and the last is as high as the ground at the
/// upper end.
struct Flight {
  ground_cover::GroundKind surface = ground_cover::GroundKind::paving_stones;
  double width_m = 0;
  std::vector<glm::dvec2> line;  // from the lower end to the upper one; E, N, m
  std::vector<double> treads_m;  // heights, from the lowest; at least one
  std::vector<double> ground_m;  // the lowest ground below each tread
};

}  // namespace nightcity::steps
