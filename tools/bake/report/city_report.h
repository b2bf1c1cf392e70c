// The reports of reading a city and of building its ground.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "tools/city/city_reader.h"
#include "tools/mesh/mesh_report.h"
#include "tools/terrain/terrain.h"

namespace nightcity::bake {

struct CityReport {
  city::ReadReport read;
  mesh::MeshReport mesh;
  std::map<std::string, std::size_t> objects;   // by type
  std::map<std::string, std::size_t> left_out;  // objects, by reason
  std::size_t beyond_heights = 0;  // objects that stand on a height of an elevation model near them
};

struct GroundReport {
  /// "given" (triangles of the model), "points" (its mass points and break lines), "dem", "made",
  /// "none".
  std::string source;
  terrain::Terrain::BreakEdges break_edges;
  std::size_t relief_points = 0;     // mass points and vertices of break lines
  std::size_t lone_vertices = 0;     // break lines of which the vertices alone are used
  double beyond_relief_percent = 0;  // feet of buildings beyond it, for which it was made to go on
  bool shown = false;                // the scene shows the terrain
  bool has_roads = false;            // the model has roads of its own
  bool has_bridges = false;          // the model has bridges of its own
  bool has_land = false;             // the model has land use or water of its own
  std::string dem;  // how an elevation model was used, or why not; "" = none was given
};

}  // namespace nightcity::bake
