#include "tools/bake/variants.h"

namespace nightcity::bake {
namespace {

bool has_city(const Recipe& recipe) {
  return !recipe.city.files.empty();
}

bool has_map(const Recipe& recipe) {
  return !recipe.osm.files.empty();
}

template <lights::WindowGrouping grouping>
bool can_group(const Recipe& recipe) {
  return recipe.windows.lit && recipe.windows.group < grouping;
}

bool makes_streets(const Recipe& recipe) {
  return has_map(recipe) && recipe.ground.streets;
}

// Returns whether a bake with this tolerance loses what the recipe's keeps.
template <int micrometres>
bool is_coarser(const Recipe& recipe) {
  return !recipe.output.draco || recipe.output.draco_tolerance_m < micrometres * 1e-6;
}

template <int micrometres>
void compress(Recipe& recipe) {
  recipe.output.draco = true;
  recipe.output.draco_tolerance_m = micrometres * 1e-6;
}

template <int metres>
bool has_other_tiles(const Recipe& recipe) {
  return recipe.city.tile_m != metres;
}

// The ground's tiles are the city's (Recipe::terrain).
template <int metres>
void set_tiles(Recipe& recipe) {
  recipe.city.tile_m = metres;
}

template <int millimetres>
bool is_straighter(const Recipe& recipe) {
  return recipe.city.simplify_m < millimetres * 1e-3;
}

template <int millimetres>
void straighten(Recipe& recipe) {
  recipe.city.simplify_m = millimetres * 1e-3;
}

template <int millimetres>
bool is_thinner(const Recipe& recipe) {
  return recipe.terrain.max_error_m < millimetres * 1e-3;
}

template <int millimetres>
void thin(Recipe& recipe) {
  recipe.terrain.max_error_m = millimetres * 1e-3;
}

template <int metres>
bool can_merge(const Recipe& recipe) {
  return (has_map(recipe) || !recipe.lamps.inventories.empty()) && recipe.lamps.merge_m < metres;
}

template <int metres>
void merge(Recipe& recipe) {
  recipe.lamps.merge_m = metres;
}

}  // namespace

const std::vector<Variant>& list_variants() {
  static const std::vector<Variant> variants{
      {"draco-1mm", "[output] draco = true, draco_tolerance_m = 0.001", "coordinates to 1 mm",
       0.001, is_coarser<1'000>, compress<1'000>},
      {"draco-10mm", "[output] draco = true, draco_tolerance_m = 0.01", "coordinates to 10 mm",
       0.01, is_coarser<10'000>, compress<10'000>},
      {"draco-100mm", "[output] draco = true, draco_tolerance_m = 0.1", "coordinates to 100 mm",
       0.1, is_coarser<100'000>, compress<100'000>},
      {"draco-1m", "[output] draco = true, draco_tolerance_m = 1", "coordinates to 1 m", 1,
       is_coarser<1'000'000>, compress<1'000'000>},
      {"tiles-125m", "[city] tile_m = 125", "nothing: smaller tiles", 0, has_other_tiles<125>,
       set_tiles<125>},
      {"tiles-1000m", "[city] tile_m = 1000", "nothing: larger tiles", 0, has_other_tiles<1000>,
       set_tiles<1000>},
      {"lod-1", "[city] lod = 1", "roofs: buildings are blocks, where the model has such", 0,
       [](const Recipe& r) { return has_city(r) && r.city.read.max_lod > 1; },
       [](Recipe& r) { r.city.read.max_lod = 1; }},
      {"simplify-100mm", "[city] simplify_m = 0.1", "corners of buildings within 0.1 m of an edge",
       0.1, is_straighter<100>, straighten<100>},
      {"simplify-500mm", "[city] simplify_m = 0.5", "corners of buildings within 0.5 m of an edge",
       0.5, is_straighter<500>, straighten<500>},
      {"ground-100mm", "[terrain] max_error_m = 0.1", "vertices of the ground, heights to 0.1 m",
       0.1, is_thinner<100>, thin<100>},
      {"ground-1m", "[terrain] max_error_m = 1", "vertices of the ground, heights to 1 m", 1,
       is_thinner<1000>, thin<1000>},
      {"lamps-20m", "[lamps] merge_m = 20", "lamps within 20 m of a stronger one", 0, can_merge<20>,
       merge<20>},
      {"lamps-60m", "[lamps] merge_m = 60", "lamps within 60 m of a stronger one", 0, can_merge<60>,
       merge<60>},
      {"no-hidden", "[city] drop_ground = true, drop_hidden = true", "surfaces that nobody sees", 0,
       [](const Recipe& r) { return has_city(r) && !(r.city.drop_ground && r.city.drop_hidden); },
       [](Recipe& r) { r.city.drop_ground = r.city.drop_hidden = true; }},
      {"windows-storey", "[windows] group = \"storey\"", "single windows: one emitter a storey", 0,
       [](const Recipe& r) { return can_group<lights::WindowGrouping::storey>(r); },
       [](Recipe& r) { r.windows.group = lights::WindowGrouping::storey; }},
      {"windows-facade", "[windows] group = \"facade\"", "single windows: one emitter a wall", 0,
       [](const Recipe& r) { return can_group<lights::WindowGrouping::facade>(r); },
       [](Recipe& r) { r.windows.group = lights::WindowGrouping::facade; }},
      {"even-windows", "[windows] panes = false", "frames and rooms of windows, what glass mirrors",
       0,
       [](const Recipe& r) {
         return r.windows.lit && r.windows.panes && r.windows.group == lights::WindowGrouping::none;
       },
       [](Recipe& r) { r.windows.panes = false; }},
      {"no-map-lights", "[map_lights] lit = false", "signs, floodlights, petrol stations", 0,
       [](const Recipe& r) { return has_map(r) && r.map_lights.lit; },
       [](Recipe& r) { r.map_lights.lit = false; }},
      {"no-vegetation", "[city] vegetation = \"none\"", "trees and other plants of the model", 0,
       [](const Recipe& r) { return has_city(r) && r.city.vegetation != trees::Vegetation::none; },
       [](Recipe& r) { r.city.vegetation = trees::Vegetation::none; }},
      {"no-barriers", "[ground] barriers = false", "walls, hedges and fences of the map", 0,
       [](const Recipe& r) { return has_map(r) && r.ground.barriers; },
       [](Recipe& r) { r.ground.barriers = false; }},
      {"no-horizon", "[ground] horizon = false", "ground beyond the city's own", 0,
       [](const Recipe& r) { return r.ground.horizon; },
       [](Recipe& r) { r.ground.horizon = false; }},
      {"no-markings", "[ground] markings = false", "paint on carriageways", 0,
       [](const Recipe& r) { return makes_streets(r) && r.ground.markings; },
       [](Recipe& r) { r.ground.markings = false; }},
      {"no-lowered-kerbs", "[ground] lowered_kerbs = false", "ramps at crossings", 0,
       [](const Recipe& r) { return makes_streets(r) && r.ground.lowered_kerbs; },
       [](Recipe& r) { r.ground.lowered_kerbs = false; }},
      {"no-rounded-corners", "[ground] rounded_corners = false", "arcs of kerbs at junctions", 0,
       [](const Recipe& r) { return makes_streets(r) && r.ground.rounded_corners; },
       [](Recipe& r) { r.ground.rounded_corners = false; }},
      {"no-parking", "[ground] parking = false", "bays along carriageways", 0,
       [](const Recipe& r) { return makes_streets(r) && r.ground.parking; },
       [](Recipe& r) { r.ground.parking = false; }},
      {"no-rails", "[ground] rails = false", "tracks", 0,
       [](const Recipe& r) { return has_map(r) && r.ground.rails; },
       [](Recipe& r) { r.ground.rails = false; }},
      {"no-bridges", "[ground] bridges = false", "decks of bridges above the ground", 0,
       [](const Recipe& r) { return makes_streets(r) && r.ground.bridges; },
       [](Recipe& r) { r.ground.bridges = false; }},
      {"no-steps", "[ground] steps = false", "treads and risers of steps", 0,
       [](const Recipe& r) { return makes_streets(r) && r.ground.steps; },
       [](Recipe& r) { r.ground.steps = false; }},
      {"no-streets", "[ground] streets = false", "streets as surfaces", 0, makes_streets,
       [](Recipe& r) { r.ground.streets = false; }},
      {"no-land", "[ground] land = false", "land of the map", 0,
       [](const Recipe& r) { return has_map(r) && r.ground.land; },
       [](Recipe& r) { r.ground.land = false; }},
      {"no-gaps", "[ground] gaps = false", "buildings of the map that the model lacks", 0,
       [](const Recipe& r) { return has_map(r) && has_city(r) && r.ground.gaps; },
       [](Recipe& r) { r.ground.gaps = false; }},
  };
  return variants;
}

}  // namespace nightcity::bake
