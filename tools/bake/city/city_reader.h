// From CityGML files to triangles: every object read, placed, triangulated, sorted into tiles and, where one
// may stand on it, handed to the terrain.
#pragma once

#include <optional>

#include "formats/scene_file.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/progress.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/bake/report/bake_report.h"
#include "tools/bake/scene/drape.h"
#include "tools/bake/scene/tile_store.h"
#include "tools/lights/windows.h"
#include "tools/streets/road_surfaces.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

/// Where the triangles go.
struct CitySinks {
  SceneWriter& writer;
  TileStore& tiles;
  DrapeStore& drape;  // objects without heights
  Terrain& terrain;
  std::optional<WindowLayout>& windows;    // empty: no windows are wanted
  streets::RoadSurfaces* roads = nullptr;  // null: no streets are wanted of the model
};

/// Each object becomes a feature of the writer as it is read; memory does not grow with the city but for what
/// the terrain keeps. Objects over 100 km from the city's first file and objects that an earlier file has
/// brought are left out and counted. Throws Error as inputs::read_city does.
void read_city(const Recipe& recipe, const CityFrames& frames, const CitySinks& sinks,
               BakeReport& report, const ProgressSink& progress);

/// Puts a mesh that belongs to no object (a made terrain) into the tiles.
void add_mesh(TileStore& tiles, const TriangleMesh& mesh, ObjectType type, std::uint32_t feature);

}  // namespace nightcity
