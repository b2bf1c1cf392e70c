// Options that decide how the ground of a city is made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/terrain/open_models.h"

namespace nightcity::bake {

struct GroundOptions {
  /// Elevation models (any raster that GDAL reads, also in archives) for a city without relief of
  /// its own, or beyond it. The finest that has a height at a place decides it, of about equally
  /// fine ones the first; between tiles that meet, both do.
  std::vector<std::filesystem::path> elevation_models;
  std::string elevation_crs;  // of those that name none; "": the city's
  /// The city's objects stand on the elevation models already: these are not moved to meet them.
  bool carries_buildings = false;
  int max_dem_block_mpx = terrain::default_max_block_mpx;
  int max_dem_unpacked_mb = terrain::ElevationOptions{}.max_unpacked_mb;
  bool make_surface = true;  // show the surface that is made where there is none, or a gap
  /// By which the ground's heights may be off where vertices are left out; 0: all stay.
  double max_error_m = 0;
  double margin_m = 50;  // how far made ground reaches beyond the city
  /// The ground of a city that is its map alone goes on with streets and tracks, at most so far
  /// beyond the buildings.
  double map_reach_m = 500;
  bool keeps_outline = false;  // remember the edge of the ground, where the horizon begins
  double tile_m = 250;         // side of the tiles that the ground comes in
};

}  // namespace nightcity::bake
