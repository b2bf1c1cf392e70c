// A recipe: which files make a city and how, as TOML. Two keys suffice: [city] files and [osm] files.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/citygml/city_model.h"
#include "tools/georeference/frame.h"
#include "tools/layout/layout.h"
#include "tools/lights/lamp_hours.h"
#include "tools/traffic/traffic.h"

namespace nightcity {

struct Recipe {
  std::filesystem::path
      path;  // of the recipe itself; files below are already relative to the working folder

  struct City {
    std::vector<std::filesystem::path>
        files;  // CityGML; a folder stands for the files in it that city_files() names
    CityFrame::Options frame;  // crs = "EPSG:...", control_points = [[lon, lat, x, y], ...]
    std::optional<std::array<double, 4>>
        bounds;        // of a model without CRS: west, south, east, north, degrees
    ReadOptions read;  // lod = 2, reader = "stream" | "libcitygml", threads = 0
    double tile_m = 250;
    bool drop_ground = false;  // leave out the ground surfaces under buildings: nothing sees them
    bool drop_hidden = false;  // leave out walls between houses and what lies below the ground
    std::vector<std::string> licences;  // licence = "..." or [...]
  } city;

  struct Osm {
    std::vector<std::filesystem::path> files;
    std::string licence = "OpenStreetMap contributors, ODbL 1.0";
  } osm;

  struct Lamps {
    struct LuminaireFile {
      std::filesystem::path file;         // IES LM-63 or EULUMDAT
      std::vector<std::string> highways;  // roads = ["residential", ...]; absent: every road
      std::vector<LampType> types;        // types = ["led", ...]; absent: every type
      bool take_flux = true;              // flux = false: the table's lumens stay
    };
    layout::LayoutOptions
        layout;       // layout = "auto" | "never" | "always", class = {residential = "P4", ...}
    LampHours hours;  // off, half_night = {residential = "23:00-05:00", ...}
    std::vector<LuminaireFile>
        luminaires;  // luminaires = [{file = "street.ldt", roads = [...]}, ...]
  } lamps;

  struct Terrain {
    std::vector<std::filesystem::path>
        dem;                   // elevation models (GDAL), for a city without relief of its own
    bool make_surface = true;  // where there is neither: a surface through the buildings' feet
    double margin_m = 50;      // how far that surface reaches beyond the buildings
  } terrain;

  struct Origin {  // of model space, in the city's CRS; what is absent is chosen from the data
    std::optional<double> easting, northing, height;
  } origin;

  struct Windows {
    bool lit = true;         // false: none
    std::uint64_t seed = 1;  // who is at home
  } windows;

  struct Traffic {
    bool drives = false;  // the table is there, and does not say drives = false
    traffic::TrafficOptions
        options;  // vehicles = N | per_km, cycle_s, side = "left" | "right", hours, seed
  } traffic;

  struct Night {
    int minute =
        5 * 60;  // after 17:00 (time = "22:00"): of what city.glb shows programs that know no clock
  } night;

  struct Output {
    bool draco = false;
    double draco_tolerance_m = 0.01;
    std::size_t punctual = 0;  // so many of the brightest lights as KHR_lights_punctual
  } output;
};

/// One of [city] and [osm] files is there; CityFrames asks for the first. Throws Error where the file is
/// missing or no TOML, UsageError (with line and the nearest known key) where
/// a table, key or value is not one of ours.
Recipe read_recipe(const std::filesystem::path& path);

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours) from `word`; "" when
/// none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace nightcity
