// A city, opened once: its frame, its map, and, when it has been read, its ground.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "formats/file_names.h"
#include "formats/georeference.h"
#include "tools/bake/city/city_bridges.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/city_inputs.h"
#include "tools/bake/city/ground_builder.h"
#include "tools/bake/city/ground_heights.h"
#include "tools/bake/city/map_gaps.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/city_report.h"
#include "tools/bake/report/street_report.h"
#include "tools/ground_cover/cover.h"
#include "tools/inventory/read_inventory.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/streets/road_surfaces.h"
#include "tools/terrain/terrain.h"

namespace nightcity::bake {

/// Without a city model, the map lies on a plane at height 0, in the UTM zone of its middle. A
/// model of the map's own buildings stands on elevation models where there are some.
class City {
 public:
  /// Reads the maps, the inventories and the heads of the city's files. Scratch files lie beside
  /// `scratch`. Throws Error, or UsageError where the inputs contradict each other.
  explicit City(CityInputs inputs,
                const std::filesystem::path& scratch = scratch_folder() / "nightbake");
  City(const City&) = delete;
  City& operator=(const City&) = delete;

  /// Reads the city model and passes each object to the ground and to `consumers`. Throws Error as
  /// the reader of its files does.
  CityReport read(std::initializer_list<CityConsumer*> consumers, const ProgressSink& progress);
  /// Builds the ground from what has been read; `show` gets what is to be seen of it. Then passes
  /// the buildings of the map that the model lacks to `consumers`, and covers the ground. Throws
  /// Error where an elevation model cannot be read or covers nothing of the city.
  GroundReport build_ground(std::initializer_list<CityConsumer*> consumers = {},
                            const GroundBuilder::ShowGround& show = {});
  /// Returns the buildings of the map that stand where the model has none.
  const GapReport& gaps() const { return gaps_; }
  /// Returns what covers the ground; empty before build_ground().
  const ground_cover::Cover& cover() const { return cover_; }

  /// Returns the bridges of the map; without decks before build_ground().
  const CityBridges& bridges() const { return bridges_; }

  const CityInputs& inputs() const { return inputs_; }
  /// False for a map without a city model.
  bool has_model() const { return frames_.has_value(); }
  /// Returns the frames of the city model's files. Throws UsageError where there is no model.
  const CityFrames& frames() const;
  /// Returns the frame of model and map. Throws Error where there is no model and the map has
  /// neither a lamp nor a street.
  const georeference::CityFrame& frame() const;
  /// Returns the map, with the lamps of inventories among its own.
  const osm::OsmData& map() const { return map_; }
  /// Returns the heights of the ground that the model's objects are put onto; null where they have
  /// heights of their own.
  const GroundHeights* ground_heights() const { return heights_ ? &*heights_ : nullptr; }
  const std::vector<inventory::InventoryReport>& inventories() const { return inventory_reports_; }
  const terrain::Terrain& terrain() const { return terrain_; }
  /// Returns the edge of the ground; empty before build_ground().
  const terrain::Outline& ground_outline() const { return ground_.outline(); }

  /// Throws Error where the city has no coordinate reference system: then longitude and latitude
  /// have no place in it. `consequence` ends the message ("lamps cannot be placed").
  void require_lon_lat(const std::string& consequence) const;

  /// Returns the city's CRS, sources and licences. The origin is the inputs' own; what they do not
  /// say is `middle` (easting, northing), else a place in the middle of the city.
  Georeference georeference(const std::optional<glm::dvec2>& middle = {}) const;

  /// Returns the squares of the maps (names::select_squares), each once.
  std::vector<osm::MapArea> read_squares() const;

  /// Returns whether streets can come from the model's roads alone: the map has none.
  bool wants_model_streets() const;
  /// Adds the centrelines of the model's roads to the map, as its streets.
  StreetReport add_model_streets(const streets::RoadSurfaces& roads);

  // Place queries. They refer to the city, and need its ground where it has a model.

  /// Returns a function from longitude and latitude to E, N.
  place::LonLatToFrame to_frame() const;
  /// Returns the height of the terrain as it is covered, of a road or of a building's ground
  /// surface; on a roof, none.
  place::HeightAt height_at() const;
  /// Returns whether a place lies on a building's ground surface. Empty where there is no model.
  place::InsideBuilding inside_footprint() const;

 private:
  struct MapFrame {
    glm::dvec2 middle{0, 0};  // longitude, latitude
    georeference::CityFrame frame;
  };
  void report_moved_origin() const;
  static std::optional<MapFrame> find_map_frame(const osm::OsmData& map);
  void fill_gaps(std::initializer_list<CityConsumer*> consumers);
  /// Says on stderr what of the maps is left out.
  void note_left_out() const;
  void add_barrier_outlines();
  void add_land(const ground_cover::Box& bounds);
  bool drives_on_the_left() const;
  void lay_cover(const GroundReport& ground);
  void add_inventory_licences(std::vector<std::string>& licences) const;

  CityInputs inputs_;
  std::optional<CityFrames> frames_;
  std::optional<GroundHeights> heights_;  // that a map's buildings stand on
  osm::OsmData map_;
  std::vector<inventory::InventoryReport> inventory_reports_;
  std::optional<MapFrame> map_frame_;  // where there is no model
  terrain::Terrain terrain_;
  GroundBuilder ground_;
  ground_cover::Cover cover_;
  CityBridges bridges_;
  GapReport gaps_;
};

}  // namespace nightcity::bake
