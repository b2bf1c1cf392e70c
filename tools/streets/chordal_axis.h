// The chordal axis of an outline (Prasad 1997): it joins the middles of the chords that a
// constrained Delaunay triangulation draws across the outline. For a straight street it is
// exactly the centreline.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "tools/streets/road_outline.h"

namespace nightcity::streets {

/// A triangulation of so many points takes some 1 GB.
constexpr int default_max_road_points = 5'000'000;

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
/// so that chords lie across the street. Throws Error where these are more than `max_points`.
Axis chordal_axis(std::span<const OutlineEdge> outline, double step_m,
                  int max_points = default_max_road_points);

/// Returns the order in which the ends of an edge's pieces, from 0 to `parts`, are inserted. Those
/// of an edge of more than 256 pieces come from the coarse to the fine: beside a parallel edge each
/// next point along it would take over half of all that the last one sees.
std::vector<std::size_t> list_insertions(std::size_t parts);

}  // namespace nightcity::streets
