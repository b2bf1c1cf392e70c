// The tables of a recipe with their keys. A new key is one row in one of these functions.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/bake/recipe/key.h"
#include "tools/bake/recipe/recipe.h"

namespace nightcity::recipe {

/// Returns all tables of a recipe. Their keys write into `recipe`, which must outlive them, and
/// take names of files relative to `folder`.
std::vector<Table> make_tables(bake::Recipe& recipe, const std::filesystem::path& folder);

Table make_city_table(bake::Recipe::City& city, const std::filesystem::path& folder);
Table make_terrain_table(bake::GroundOptions& terrain, const std::filesystem::path& folder);
Table make_ground_table(bake::CoverOptions& ground);
Table make_lamp_table(bake::LampStageOptions& lamps, const std::filesystem::path& folder);
Table make_map_light_table(map_lights::MapLightOptions& lights);
Table make_traffic_table(bake::Recipe::Traffic& traffic);

/// Returns the keys of one row of `[lamps] luminaires`.
Table make_luminaire_table(bake::LuminaireFile& row, const std::filesystem::path& folder);

/// Returns the keys of one row of `[lamps] inventories`.
Table make_inventory_table(inventory::InventoryFile& row, const std::filesystem::path& folder);

}  // namespace nightcity::recipe
