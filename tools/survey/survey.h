// Looks at files that may make a city, and tells what each of them is.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/inventory/inventory.h"
#include "tools/survey/box.h"

namespace nightcity::survey {

enum class Use {
  city,       // a city model
  map,        // OpenStreetMap
  elevation,  // a raster of heights
  inventory,  // a table of lamps
  luminaire,  // photometry
  companion,  // belongs to another file: textures, a Shapefile's parts
  nothing     // cannot be used, or is of no use here
};

struct SurveyedFile {
  std::filesystem::path path;
  Use use = Use::nothing;
  std::string what;  // "CityGML 2.0, EPSG:25833"; of a file without a use: why
  Box box;           // where it lies; of a city model its beginning; empty: unknown
  bool has_crs = false;
  std::string crs;                                    // of a city model or raster: "EPSG:25833"
  bool is_obj = false;                                // a city model that states no place
  bool has_roads = false, has_relief = false;         // city models: the text names such objects
  std::size_t lamps = 0, streets = 0, buildings = 0;  // of a map
  std::optional<inventory::InventoryFile> inventory;
};

/// Returns the files, those in folders too, sorted by path; an archive once for each use that it
/// has. A table that names no CRS, and whose
/// places are no degrees, has that of another file, or one that is usual there, by which it lies
/// beside the others. Never throws for what a file holds: it is then one without a use. Throws
/// Error where a path does not exist or a folder cannot be read.
std::vector<SurveyedFile> survey_files(const std::vector<std::filesystem::path>& paths);

}  // namespace nightcity::survey
