// A recipe names the files that make a city and the options of the bake, as TOML. Two keys suffice:
// [city] files and [osm] files. docs/recipe.md describes every key.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/bake/city/cover_options.h"
#include "tools/bake/city/ground_options.h"
#include "tools/bake/stages/lamp_options.h"
#include "tools/bake/stages/window_options.h"
#include "tools/city/city_reader.h"
#include "tools/georeference/frame.h"
#include "tools/map_lights/map_light_options.h"
#include "tools/osm/osm_data.h"
#include "tools/streets/chordal_axis.h"
#include "tools/traffic/traffic.h"
#include "tools/trees/model_tree.h"

namespace nightcity::bake {

/// A stage's options are kept in the stage's own type.
struct Recipe {
  /// Path of the recipe itself. All paths below are relative to the working folder.
  std::filesystem::path path;

  struct City {
    /// CityGML files; folders are already replaced by the files in them.
    std::vector<std::filesystem::path> files;
    georeference::CityFrame::Options frame;
    /// The bounds of a model without a coordinate reference system: west,
    /// south, east, north in degrees.
    std::optional<std::array<double, 4>> bounds;
    city::ReadOptions read;
    double tile_m = 250;
    double simplify_m = 0;       // as CityInputs'
    double texels_per_m = 5;     // as CityInputs'
    int max_picture_mpx = 2000;  // as CityInputs'
    int max_road_points = streets::default_max_road_points;
    bool drops_roads = false;
    bool drop_ground = false;
    bool drop_hidden = false;
    bool skins = true;
    trees::Vegetation vegetation = trees::Vegetation::trees;
    std::vector<std::string> licences;
  } city;

  struct Osm {
    std::vector<std::filesystem::path> files;
    /// Without a city model, the buildings of the map are the model.
    bool buildings = true;
    /// The map's buildings have the colours that their tags say.
    bool colours = true;
    std::string licence = "OpenStreetMap contributors, ODbL 1.0";
    int max_way_nodes = static_cast<int>(osm::default_max_way_nodes);
  } osm;

  LampStageOptions lamps;
  map_lights::MapLightOptions map_lights;
  /// Its tile_m is the city's.
  GroundOptions terrain;
  CoverOptions ground;

  /// Origin of model space in the city's CRS, m; what is absent is chosen from the data.
  struct Origin {
    std::optional<double> easting, northing, height;
  } origin;

  WindowStageOptions windows;

  struct Lights {
    /// Files of edited lights.
    std::vector<std::filesystem::path> edits;
  } lights;

  struct Traffic {
    /// True where the recipe has the table [traffic] and does not say drives = false.
    bool is_made = false;
    traffic::TrafficOptions options;
  } traffic;

  struct Night {
    /// The moment that city.glb shows, in minutes after 17:00.
    int minute = 5 * 60;
  } night;

  struct Output {
    bool draco = false;
    double draco_tolerance_m = 0.01;
    /// city.glb holds the hierarchies of its static triangles.
    bool hierarchies = true;
    /// Number of lights to copy into city.glb as KHR_lights_punctual, brightest first.
    std::size_t punctual = 0;
  } output;
};

/// Reads a recipe. At least one of [city] files and [osm] files is present (a bake needs the
/// first). Throws Error where the file is missing or not TOML, and UsageError, with line and the
/// nearest known word, where a table, key or value is not one of docs/recipe.md.
Recipe read_recipe(const std::filesystem::path& path);

}  // namespace nightcity::bake
