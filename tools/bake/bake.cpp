#include "tools/bake/bake.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/light_file_edit.h"
#include "tools/bake/city/building_uses.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/city/obstacles.h"
#include "tools/bake/city/ready_object.h"
#include "tools/bake/city/road_consumer.h"
#include "tools/bake/city/tree_consumer.h"
#include "tools/bake/output_folder.h"
#include "tools/bake/parts/fingerprint.h"
#include "tools/bake/parts/read_parts.h"
#include "tools/bake/report/report_text.h"
#include "tools/bake/report/stage_clock.h"
#include "tools/bake/scene/bridge_models.h"
#include "tools/bake/scene/hierarchies.h"
#include "tools/bake/scene/horizon_model.h"
#include "tools/bake/scene/map_models.h"
#include "tools/bake/scene/scene_tiles.h"
#include "tools/bake/scene/tree_models.h"
#include "tools/bake/scene/vehicle_models.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/bake/stages/places_stage.h"
#include "tools/bake/stages/traffic_stage.h"
#include "tools/trees/find_trees.h"

namespace nightcity::bake {
namespace {

std::uint64_t find_size(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return ignored ? 0 : size;
}

// Returns why a city has no surface. Objects that were left out are named with their reason.
std::string describe_emptiness(const BakeOptions& options, const CityReport& city) {
  const bool is_map = options.city.files == options.city.maps;
  std::string text =
      is_map ? "the map has no building above the ground" : "no surface in any file of the city";
  if (city.left_out.empty()) return text;
  return text + "; objects left out: " + in_words(city.left_out) +
         fmt::format(" (far: a corner over {:g} km from the city's first point)",
                     max_distance_m / 1000);
}

// One bake: the steps in their order, and what they share.
class Bake {
 public:
  Bake(const BakeOptions& options, const std::filesystem::path& folder,
       const ProgressSink& progress)
      : options_(options),
        progress_(progress),
        output_(folder),  // first: an output that cannot be written is known before the long work
        scene_path_(output_.staged("city.glb")),
        lights_path_(output_.staged("city.lights")),
        city_(std::in_place, options.city, scene_path_),
        scene_(scene_path_, options.scene),
        use_at_(make_use_finder(*city_)),
        tiles_(scene_, scene_path_, options.tiles, std::round(city_->frames().reference().z),
               use_at_),
        lights_(lights_path_) {
    for (const auto& file : options.city.files) report_.input_bytes += find_size(file);
    clock_.end_stage("reading maps");
  }

  BakeReport run() {
    read_city();
    build_ground();
    Georeference georeference =
        city_->georeference(tiles_.empty() ? std::nullopt : std::optional(tiles_.middle()));
    build_bridges();
    build_barriers();
    build_steps();
    report_.tiles = tiles_.write(georeference, *city_, progress_);
    clock_.end_stage("tiles");
    build_horizon(georeference);
    plant_trees(georeference);
    write_lights(georeference);
    PlacesOfCity places = find_places(*city_, find_extent(), georeference);
    report_.places = std::move(places.report);
    clock_.end_stage("places");
    scene_.finish(georeference, places.places);
    clock_.end_stage("writing city.glb");
    city_.reset();  // hierarchies need the most memory
    store_hierarchies();
    write_report();
    output_.commit();
    return std::move(report_);
  }

 private:
  void begin_step(const char* name) const {
    if (progress_) progress_({name, 0, ""});
  }

  void read_city() {
    if (options_.windows.lit) windows_.emplace(use_at_, options_.windows, lights_path_);
    std::optional<RoadConsumer> roads;
    if (options_.uses_streets() && city_->wants_model_streets()) roads.emplace();
    if (options_.tiles.vegetation == trees::Vegetation::trees) model_trees_.emplace();
    report_.city = city_->read({&tiles_, windows_ ? &*windows_ : nullptr, roads ? &*roads : nullptr,
                                model_trees_ ? &*model_trees_ : nullptr},
                               progress_);
    report_.crs = city_->frames().descriptions();
    clock_.end_stage("reading the city");
    if (!roads) return;
    report_.streets = city_->add_model_streets(roads->roads());
    clock_.end_stage("streets");
  }

  void build_ground() {
    begin_step("building the terrain");
    report_.ground =
        city_->build_ground({&tiles_, windows_ ? &*windows_ : nullptr},
                            [this](const mesh::TriangleMesh& mesh) { tiles_.add_ground(mesh); });
    report_.gaps = city_->gaps();
    report_.skipped_of_map = osm::count_skipped(city_->map());
    report_.cover.add(city_->cover());
    tiles_.drape(city_->height_at());
    if (tiles_.empty() && !shows_model_trees())
      throw Error(options_.city.files.front().string(), describe_emptiness(options_, report_.city));
    clock_.end_stage("terrain");
  }

  void build_bridges() {
    add_bridge_models(*city_, tiles_, report_.bridges);
    for (const auto& [layer, cover] : city_->bridges().covers()) report_.cover.add(cover);
    clock_.end_stage("bridges");
  }

  void build_barriers() {
    const auto extent = city_->terrain().extent();
    if (!options_.city.cover.barriers || !extent || !city_->frame().has_lon_lat()) return;
    add_barrier_models(*city_, *extent, tiles_, report_.barriers);
    clock_.end_stage("barriers");
  }

  void build_steps() {
    const CoverOptions& cover = options_.city.cover;
    const auto extent = city_->terrain().extent();
    if (!cover.streets || !cover.steps || !extent || report_.ground.has_roads ||
        !city_->frame().has_lon_lat())
      return;
    add_step_models(*city_, *extent, tiles_, report_.steps);
    clock_.end_stage("steps");
  }

  void build_horizon(const Georeference& georeference) {
    if (!options_.city.cover.horizon) return;
    report_.horizon =
        add_horizon_model(scene_, city_->ground_outline(), tiles_.ground_material(), georeference);
    clock_.end_stage("horizon");
  }

  void plant_trees(const Georeference& georeference) {
    const trees::Season season = options_.city.cover.trees;
    if (season == trees::Season::none) return;
    const trees::TreeSet found = find_trees();
    add_tree_models(scene_, found.trees, model_trees(), season, georeference);
    report_.trees = {
        found.sources, found.left_out, found.assumed_sizes, found.odd_sizes,
        model_trees_ ? model_trees_->surfaces() : std::map<std::string, std::size_t>()};
    clock_.end_stage("trees");
  }

  // Returns the plan of the ground, else of what is shown.
  terrain::Extent find_extent() {
    if (const auto extent = city_->terrain().extent()) return *extent;
    if (!tiles_.empty()) return tiles_.extent();
    terrain::Extent extent{model_trees().front().place, model_trees().front().place};
    for (const trees::ModelTree& tree : model_trees()) {
      extent.low = glm::min(extent.low, tree.place);
      extent.high = glm::max(extent.high, tree.place);
    }
    return extent;
  }

  // The map's trees need a ground and longitude and latitude; the model's do not.
  trees::TreeSet find_trees() const {
    const auto extent = city_->terrain().extent();
    const bool has_map = extent && city_->frame().has_lon_lat();
    static const osm::OsmData no_map;
    return trees::find_trees(
        has_map ? city_->map() : no_map, city_->cover(),
        extent ? ground_cover::Box{extent->low, extent->high} : ground_cover::Box{},
        city_->to_frame(), city_->height_at(), find_obstacles(*city_), model_trees());
  }

  bool shows_model_trees() const {
    return options_.city.cover.trees != trees::Season::none && !model_trees().empty();
  }

  std::span<const trees::ModelTree> model_trees() const {
    return model_trees_ ? model_trees_->trees() : std::span<const trees::ModelTree>();
  }

  // Gives `georeference` the identity that both files carry.
  void write_lights(Georeference& georeference) {
    begin_step("placing lights");
    BakedLights baked = bake_lights(*city_, windows_ ? &*windows_ : nullptr, options_.lights,
                                    {scene_, lights_, georeference, lights_path_});
    georeference.scene_id = lights_.scene_id(georeference);
    windows_.reset();
    report_.lights = std::move(baked.report);
    clock_.end_stage("lights");
    traffic::TrafficSet traffic;
    if (options_.makes_traffic) {
      traffic = make_city_traffic(*city_, options_.traffic, georeference, progress_);
      add_vehicle_models(scene_, traffic, night_begin_s + 60 * options_.lights.shown_minute);
      report_.traffic = traffic.report;
      clock_.end_stage("traffic");
    }
    finish_with_traffic(lights_,
                        {.georeference = georeference,
                         .profiles = baked.profiles,
                         .profile_data = baked.profile_data},
                        to_addition(traffic));
    clock_.end_stage("writing city.lights");
  }

  void store_hierarchies() {
    if (!options_.stores_hierarchies) return;
    begin_step("building hierarchies");
    report_.hierarchies = add_hierarchies(scene_path_, lights_path_, options_.tiles.threads);
    clock_.end_stage("hierarchies");
  }

  void write_report() {
    report_.scene = scene_.statistics();
    report_.scene_bytes = find_size(scene_path_);
    report_.lights_bytes = find_size(lights_path_);
    report_.stages = clock_.stages();
    AtomicFile file(output_.staged("bake_report.json"));
    file.write(to_json(report_).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
               "\n");
    file.commit();
  }

  const BakeOptions& options_;
  const ProgressSink& progress_;
  BakeReport report_;
  StageClock clock_;
  OutputFolder output_;
  std::filesystem::path scene_path_, lights_path_;
  std::optional<City> city_;  // until all of it is written
  SceneWriter scene_;
  lights::UseAt use_at_;
  SceneTiles tiles_;
  LightFileWriter lights_;
  std::optional<WindowConsumer> windows_;
  std::optional<TreeConsumer> model_trees_;
};

}  // namespace

BakeReport bake(const BakeOptions& options, const std::filesystem::path& folder,
                const ProgressSink& progress) {
  BakeOptions own = options;
  own.tiles.picture_budget =
      std::make_shared<PictureBudget>(std::uint64_t{1'000'000} * own.city.max_picture_mpx);
  own.city.picture_budget = own.tiles.picture_budget;
  return use_best_levels(own.city, [&] { return Bake(own, folder, progress).run(); });
}

BakeReport bake(const Recipe& recipe, const std::filesystem::path& folder,
                const ProgressSink& progress) {
  return bake(make_bake_options(recipe), folder, progress);
}

BakeReport merge_parts(const std::vector<std::filesystem::path>& parts,
                       const std::filesystem::path& recipe, const std::filesystem::path& folder,
                       const std::string& version, const ProgressSink& progress, unsigned threads) {
  BakeOptions options =
      make_bake_options(read_recipe(recipe.empty() ? find_recipe(parts) : recipe));
  if (threads > 0) options.city.read.threads = options.tiles.threads = threads;
  options.city.parts = find_part_set(parts, make_fingerprint(options.city, version));
  return bake(options, folder, progress);
}

}  // namespace nightcity::bake
