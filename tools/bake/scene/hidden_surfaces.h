// Walls between two houses and what lies below the ground: surfaces that no light reaches and no
// camera sees.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/bake/scene/tile_store.h"

namespace nightcity::bake {

/// Returns whether a place, in the coordinates of the triangles, lies below the ground; false where
/// the height of the ground is not known.
using BelowGround = std::function<bool(const glm::vec3&)>;

struct HiddenCounts {
  std::size_t between = 0, below = 0;  // triangles
};

/// Returns which of one tile's triangles are hidden. Only those of closed buildings can be hidden:
/// where the surface of another closed building faces the triangle, lies against it (within 1 cm)
/// and covers all of it; or where all of it lies below the ground, which is tested every 5 m. A
/// triangle that a neighbour in another tile covers is not found.
std::vector<bool> find_hidden_triangles(std::span<const TileStore::StoredTriangle> triangles,
                                        const BelowGround& below, HiddenCounts& counts);

}  // namespace nightcity::bake
