#include "tools/bake/bake_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tools/obj/level_in_name.h"

namespace nightcity::bake {
namespace {

// The files of a city in one order, however a recipe names them.
std::vector<std::filesystem::path> sort_files(std::vector<std::filesystem::path> files) {
  std::stable_sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return a.lexically_normal() < b.lexically_normal();
  });
  return files;
}

// An OBJ states no level of detail, so that objects in several cannot be told apart once they are
// read.
std::vector<std::filesystem::path> leave_out_lower_levels(std::vector<std::filesystem::path> files,
                                                          int max_lod) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.generic_string());
  const std::vector<bool> read = obj::find_best_levels(names, max_lod);
  std::vector<std::filesystem::path> best;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (read[i])
      best.push_back(std::move(files[i]));
    else
      fmt::print(stderr,
                 "note: {}: passed over: its name differs from another's in the level of detail "
                 "alone, and [city] lod = {} takes the other\n",
                 names[i], max_lod);
  return best;
}

CityInputs to_city_inputs(const Recipe& recipe) {
  CityInputs inputs;
  inputs.recipe = recipe.path;
  inputs.files = leave_out_lower_levels(sort_files(recipe.city.files), recipe.city.read.max_lod);
  inputs.maps = sort_files(recipe.osm.files);
  inputs.joined_maps = osm::join_split_maps(inputs.maps);
  inputs.max_way_nodes = recipe.osm.max_way_nodes;
  inputs.read = recipe.city.read;
  inputs.read.max_way_nodes = recipe.osm.max_way_nodes;
  inputs.read.map_colours = recipe.osm.colours;
  inputs.frame = recipe.city.frame;
  inputs.bounds = recipe.city.bounds;
  inputs.origin_easting = recipe.origin.easting;
  inputs.origin_northing = recipe.origin.northing;
  inputs.origin_height = recipe.origin.height;
  inputs.licences = recipe.city.licences;
  inputs.map_licence = recipe.osm.licence;
  inputs.inventories = recipe.lamps.inventories;
  inputs.simplify_m = recipe.city.simplify_m;
  inputs.texels_per_m = recipe.city.texels_per_m;
  inputs.max_picture_mpx = recipe.city.max_picture_mpx;
  inputs.max_road_points = recipe.city.max_road_points;
  inputs.drops_roads = recipe.city.drops_roads;
  inputs.ground = recipe.terrain;
  inputs.ground.tile_m = recipe.city.tile_m;
  inputs.ground.keeps_outline = recipe.ground.horizon;
  inputs.cover = recipe.ground;
  inputs.cover.side = recipe.traffic.options.side;
  return inputs;
}

}  // namespace

BakeOptions to_bake_options(const Recipe& recipe) {
  BakeOptions options;
  options.city = to_city_inputs(recipe);
  options.scene = {recipe.output.draco, recipe.output.draco_tolerance_m};
  options.tiles = {recipe.city.tile_m, recipe.city.drop_ground, recipe.city.drop_hidden,
                   recipe.city.skins,  recipe.city.vegetation,  recipe.city.read.threads};
  options.lights = {recipe.lamps,           recipe.map_lights,  recipe.night.minute,
                    recipe.output.punctual, recipe.city.tile_m, recipe.lights.edits};
  options.windows = recipe.windows;
  options.stores_hierarchies = recipe.output.hierarchies;
  options.makes_traffic = recipe.traffic.is_made;
  options.traffic = recipe.traffic.options;
  return options;
}

BakeOptions make_bake_options(const Recipe& recipe) {
  BakeOptions options = to_bake_options(recipe);
  if (options.city.files.empty() && recipe.osm.buildings && !options.city.maps.empty()) {
    options.city.ground.carries_buildings = !options.city.ground.elevation_models.empty();
    options.city.files = options.city.maps;
  }
  return options;
}

BakeOptions make_stage_options(const Recipe& recipe) {
  return recipe.terrain.elevation_models.empty() ? to_bake_options(recipe)
                                                 : make_bake_options(recipe);
}

}  // namespace nightcity::bake
