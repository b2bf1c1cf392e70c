// Tells what a vector file holds, without reading its rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

struct TableLook {
  std::string format, layer;     // "GeoJSON"; the layer that was looked at
  bool has_points = false;       // its geometry is points
  bool speaks_of_lamps = false;  // the name of the layer or file, or of a column, is one of lamps
  std::string crs;               // as LayerCrs takes it; "" = none
  std::int64_t rows = 0;
  std::vector<std::string> columns;
};

/// Returns the layer of points whose names speak most of lamps, of alike ones the first; else the
/// first layer. Throws Error as open_vector_file does.
TableLook look_at_table(const std::filesystem::path& file);

/// Returns whether the file's name ends as those of tables that are read, or it is packed, so that
/// it may hold one.
bool may_be_table(const std::filesystem::path& file);

/// Returns an inventory of these columns, as their names suggest: which holds the height, which the
/// watts, and so on. What no name suggests is left out.
InventoryFile guess_inventory(const std::filesystem::path& file, const TableLook& look);

}  // namespace nightcity::inventory
