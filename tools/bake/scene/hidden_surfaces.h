// Walls between two houses and what lies below the ground: surfaces that no light and no eye can reach.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/bake/scene/tile_store.h"

namespace nightcity {

/// Whether a place, as the triangles have it, lies below the ground; false where the ground is not known.
using BelowGround = std::function<bool(const glm::vec3&)>;

struct HiddenCounts {
  std::size_t between = 0, below = 0;  // triangles
};

/// Which of one tile's triangles are hidden. Solid ones alone can be: a closed building's surface is hidden
/// where another closed building's surface lies against it (within 1 cm), facing it, and covers it whole; and
/// where all of it lies below the ground, looked at every 5 m. What only a neighbour in another tile covers
/// is not known to be hidden.
std::vector<bool> hidden_triangles(std::span<const TileStore::StoredTriangle> triangles,
                                   const BelowGround& below, HiddenCounts& counts);

}  // namespace nightcity
