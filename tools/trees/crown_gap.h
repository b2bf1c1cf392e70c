// Measures how much light passes loose leaves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/trees/crown.h"

namespace nightcity::trees {

/// Returns for each of many rays the number of the first leaf in the order of `leaves` that it
/// meets, leaves.size() where it meets none. The rays are parallel and spread evenly over the disc
/// that the unit ball shows, in directions that are spread evenly over the sphere. Of n leaves from
/// the first on, those rays pass whose number is n or more.
std::vector<std::uint32_t> find_first_leaves(std::span<const LeafQuad> leaves);

/// Returns how many leaves from the first on let the share `gap` of these rays pass; all of them
/// where they are too few.
std::size_t count_leaves(std::span<const LeafQuad> leaves, double gap);

}  // namespace nightcity::trees
