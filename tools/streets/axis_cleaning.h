// From the chordal axis to streets: spurs into corners go, junctions become one point where their arms meet.
#pragma once

#include <span>
#include <vector>

#include "tools/streets/chordal_axis.h"

namespace nightcity::streets {

/// The middle line of a stretch between two nodes, ends or junctions.
struct MiddleLine {
  std::size_t from = no_node, to = no_node;
  std::vector<glm::dvec2> line;  // streets that meet share their end points, to the bit
  double width_m = 0;
};

std::vector<MiddleLine> middle_lines(Axis&& axis);

}  // namespace nightcity::streets
