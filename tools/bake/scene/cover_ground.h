// Lays streets and land onto the triangles of the terrain, which are cut along their outlines: so
// no two surfaces lie in one place.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/bake/scene/tile_store.h"
#include "tools/ground_cover/cover.h"

namespace nightcity::bake {

/// Outlines that cross more often than so many times a point leave their tile bare: an arrangement
/// costs what its crossings do. Those of six real maps cross once a point at most in any tile.
constexpr std::size_t max_outline_crossings = 8;

struct CoverCounts {
  /// In plan, m2.
  std::array<double, ground_cover::ground_kind_count> area_m2{};
  double bare_m2 = 0;           // of the triangles that were cut: what no area covers
  std::size_t triangles = 0;    // that the tile has more than before
  std::size_t uncut_tiles = 0;  // whose outlines cross too often: they stay bare
};

/// Cuts and covers the triangles of terrain among a tile's triangles; the others stay, as do those
/// of terrain that stand upright. Where a surface is sunken, its neighbours get a kerb. Vertices
/// lie on the ground as it was, and between them what is cut lies within twice facet_tolerance_m of
/// it. `origin`: of the tile (TileStore).
void cover_ground(const ground_cover::Cover& cover, const glm::dvec3& origin,
                  std::vector<TileStore::StoredTriangle>& triangles, CoverCounts& counts);

}  // namespace nightcity::bake
