// The buildings of a map as a city model, for places that have no other.
#pragma once

#include <filesystem>

#include "tools/city/city_reader.h"

namespace nightcity::map_buildings {

/// The functions of a city::FileReader for OpenStreetMap files. Coordinates are longitude and
/// latitude (EPSG:4326) and metres above the ground, which is at height 0 everywhere. A building is
/// one object; where it has parts (building:part) it consists of these alone, as in OpenStreetMap's
/// "Simple 3D Buildings". Buildings below the ground are skipped, and counted.
city::CityHead read_map_head(const std::filesystem::path& file,
                             const city::ReadOptions& options = {});
city::ReadReport read_map_buildings(const std::filesystem::path& file,
                                    const city::ReadOptions& options,
                                    const city::ObjectStage& stage);

}  // namespace nightcity::map_buildings
