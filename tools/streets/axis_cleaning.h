// Makes a chordal axis the skeleton of streets: without spurs into corners, and with one node for
// each junction.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tools/streets/chordal_axis.h"

namespace nightcity::streets {

/// A street, and so a junction, is at most so wide; a larger outline is a square.
constexpr double widest_street_m = 60;

/// The numbers of the branches that end at each node; a ring is listed twice at its node.
using BranchesAt = std::vector<std::vector<std::size_t>>;
BranchesAt list_branches_at(std::size_t nodes, std::span<const Axis::Branch> branches);

/// Returns the length of a line, m.
double length_of(std::span<const glm::dvec2> line);

/// Removes spurs that reach no farther than a corner of their junction, joins branches where only
/// two are left, and merges junctions that are nearer to each other than they are wide.
Axis clean_axis(Axis&& axis);

}  // namespace nightcity::streets
