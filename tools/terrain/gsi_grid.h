// Elevation models of the Geospatial Information Authority of Japan (GSI): grids of heights in GML.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::terrain {

/// Returns whether a file has such a model's name: "FG-GML-5339-45-00-DEM5A-20161001.xml".
bool is_named_as_gsi_grid(std::string_view name);

/// The same as an ASCII grid of degrees, and the CRS for its .prj.
struct GsiGrid {
  std::string grid, crs;
};

/// Throws Error, which names `name`, where the text lacks the grid's place or size, has more
/// heights than that or has them in another order, or states more points than a tile may have.
GsiGrid read_gsi_grid(std::string_view text, const std::string& name);

}  // namespace nightcity::terrain
