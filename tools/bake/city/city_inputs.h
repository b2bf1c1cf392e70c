// The files that a city is read from, and how they are to be understood.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/bake/city/city_survey.h"
#include "tools/bake/city/cover_options.h"
#include "tools/bake/city/ground_options.h"
#include "tools/city/city_reader.h"
#include "tools/georeference/frame.h"
#include "tools/inventory/inventory.h"
#include "tools/osm/osm_data.h"
#include "tools/osm/split_maps.h"
#include "tools/streets/chordal_axis.h"

namespace nightcity::bake {

class PictureBudget;
struct OutdatedVersions;

struct CityInputs {
  std::filesystem::path recipe;              // that names the files; empty: they were given alone
  std::vector<std::filesystem::path> files;  // city models; empty: a map without one
  std::vector<std::filesystem::path> maps;   // OpenStreetMap
  osm::JoinedMaps joined_maps;  // stands in place of `maps`, where each needs the others
  int max_way_nodes = static_cast<int>(osm::default_max_way_nodes);
  city::ReadOptions read;  // of the CityGML
  georeference::CityFrame::Options frame;
  /// The bounds of a model without a CRS: west, south, east, north, degrees (WGS 84).
  std::optional<std::array<double, 4>> bounds;
  /// Origin of model space, in the city's CRS, in metres; an absent value is chosen from the data.
  std::optional<double> origin_easting, origin_northing, origin_height;
  std::vector<std::string> licences;  // of the CityGML
  /// Lamps that a town knows, to be joined with those of the maps.
  std::vector<inventory::InventoryFile> inventories;
  std::string map_licence = "OpenStreetMap contributors, ODbL 1.0";
  /// By which corners that are left out may lie off the outlines of buildings, m; 0: all stay.
  double simplify_m = 0;
  double texels_per_m = 5;     // of pictures on surfaces, at most
  int max_picture_mpx = 2000;  // a limit: millions of texels of all pictures on surfaces
  /// The budget of the bake that reads the city; null: whoever reads it makes all pictures.
  std::shared_ptr<const PictureBudget> picture_budget;
  int max_road_points = streets::default_max_road_points;  // a limit: chordal_axis()
  bool drops_roads = false;  // of the model, where there is a map: its streets stand for them
  GroundOptions ground;
  CoverOptions cover;
  /// The result of an earlier look at all inputs: the city does not look again, and reads only the
  /// buildings of the map. Null: the city looks itself.
  std::shared_ptr<const CitySurvey> survey;
  /// Versions of objects to be left out since better ones stand elsewhere (use_best_levels); null:
  /// none is known.
  std::shared_ptr<const OutdatedVersions> outdated;
  /// Finished parts of this bake, in order: the objects come from them. Empty: from the files.
  std::vector<std::filesystem::path> parts;

  /// Returns the file to name in a message about the inputs as a whole: the recipe, else the first
  /// file.
  std::string name() const;
  /// Returns whether the city's model is nothing but its map. Without an elevation model it stands
  /// on a plane at height 0 then, and so does all that lies beyond its ground.
  bool is_map_alone() const;
};

}  // namespace nightcity::bake
