// The report about the city's surfaces in the scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "tools/bake/report/skin_report.h"

namespace nightcity::bake {

/// Pictures on surfaces.
struct TextureReport {
  std::size_t surfaces = 0, triangles = 0;  // under pictures
  std::size_t pictures = 0;                 // of the scene
  std::uint64_t texels = 0, bytes = 0;      // of these
  std::size_t beyond_limit = 0;             // surfaces that keep the mean colour: PictureBudget
};

struct SceneTilesReport {
  std::map<std::string, std::size_t> triangles;  // by material, as written
  std::map<std::string, std::size_t> left_out;   // triangles, by reason
  std::size_t colours = 0;                       // materials that the model itself names
  TextureReport textures;
  SkinReport skins;
  std::map<std::string, double> cover_m2;  // in plan, by what the ground is covered with
  double bare_m2 = 0;                      // in plan: ground near it that nothing covers
  std::size_t cover_triangles = 0;         // that cutting the ground has added
  std::size_t uncovered_tiles = 0;         // left bare: outlines cross too often
  std::size_t draped = 0;  // triangles that were published without heights and put onto the ground
};

/// The hierarchies that city.glb holds; zeros where it holds none.
struct HierarchyReport {
  std::size_t triangles = 0, nodes = 0;
  std::uint64_t bytes = 0;
};

/// The ground beyond the city's own.
struct HorizonReport {
  std::size_t rings = 0;      // round the ground
  std::size_t triangles = 0;  // of the surface around them
  std::string left_out;       // why there is none; "" where there is, or no ground
};

}  // namespace nightcity::bake
