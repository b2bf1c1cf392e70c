// What the city stands on: its own relief, else elevation models, else a surface through the buildings' feet.
#pragma once

#include <string>

#include "tools/bake/city/city_frames.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/bake/scene/tile_store.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

struct GroundReport {
  /// "given" (triangles of the model), "points" (its mass points and break lines), "dem", "made", "none".
  std::string source;
  Terrain::BreakEdges break_edges;
  std::string dem;  // how an elevation model was used, or why not; "" = the recipe names none
};

/// Call when every object has been read. Adds the ground's triangles to `terrain` and builds it; those that
/// are to be seen go to `tiles`. Throws Error where an elevation model cannot be read or covers nothing of
/// the city.
GroundReport lay_ground(const Recipe& recipe, const CityFrames& frames, Terrain& terrain,
                        TileStore& tiles);

}  // namespace nightcity
