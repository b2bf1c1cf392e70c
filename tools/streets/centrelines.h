// Turns a chordal axis into streets: straight lines, and junctions that are one point where their
// arms meet.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/streets/chordal_axis.h"

namespace nightcity::streets {

/// The centreline of a stretch between two nodes, which are ends or junctions.
struct Centreline {
  std::size_t from = no_node, to = no_node;
  std::vector<glm::dvec2> line;  // streets that meet share exactly the same end points
  double width_m = 0;
};

std::vector<Centreline> find_centrelines(Axis&& axis);

}  // namespace nightcity::streets
