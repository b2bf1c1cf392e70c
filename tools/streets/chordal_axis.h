// The chordal axis of an outline (Prasad 1997): it joins the middles of the chords that a
// constrained Delaunay triangulation draws across the outline. For a straight street it is
// exactly the centreline.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "tools/streets/road_outline.h"

namespace nightcity::streets {

constexpr std::size_t no_node = std::numeric_limits<std::size_t>::max();

struct Axis {
  struct Node {
    glm::dvec2 place{0, 0};
    double reach_m = 0;            // size of a junction
    std::vector<glm::dvec2> tips;  // of a dead end: corners of the outline beyond it
  };
  struct Branch {
    std::size_t from = no_node, to = no_node;  // nodes; the same one for a ring
    std::vector<glm::dvec2> line;
    // Width of the outline between each two points of the line; 0: inside a junction.
    std::vector<double> width_m;
  };
  std::vector<Node> nodes;
  std::vector<Branch> branches;
};

/// Returns the chordal axis. The outline's edges are first divided into pieces of at most `step_m`,
/// so that chords lie across the street.
Axis chordal_axis(std::span<const OutlineEdge> outline, double step_m);

}  // namespace nightcity::streets
