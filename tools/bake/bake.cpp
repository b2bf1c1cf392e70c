#include "tools/bake/bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/city_ground.h"
#include "tools/bake/city/city_reader.h"
#include "tools/bake/city/ground_builder.h"
#include "tools/bake/output_folder.h"
#include "tools/bake/report/peak_memory.h"
#include "tools/bake/scene/hidden_surfaces.h"
#include "tools/bake/scene/materials.h"
#include "tools/bake/scene/tile_store.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/bake/stages/traffic_stage.h"
#include "tools/in_order.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {
namespace {

constexpr double hidden_below_m = 0.1;  // under the ground's surface, which is no more exact

class Stopwatch {
 public:
  explicit Stopwatch(BakeReport& report) : report_(report) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    report_.stages.push_back(
        {stage, std::chrono::duration<double>(now - start_).count(), peak_memory_mb()});
    start_ = now;
  }

 private:
  BakeReport& report_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::uint64_t size_of(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return ignored ? 0 : size;
}

OsmData read_maps(const Recipe& recipe) {
  OsmData data;
  for (const auto& file : recipe.osm.files) data.merge(read_osm(file));
  return data;
}

// The middle of the city, to the metre: far objects must not move it, so the median of the tiles is taken.
Georeference georeference_amid(const Recipe& recipe, const CityFrames& frames, TileStore& tiles) {
  Georeference result = georeference_of(recipe, frames);
  std::vector<double> eastings, northings;
  for (const TileKey& key : tiles.tiles()) {
    eastings.push_back(tiles.origin(key).x);
    northings.push_back(tiles.origin(key).y);
  }
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return std::round(*middle);
  };
  result.origin.x = recipe.origin.easting.value_or(median(eastings));
  result.origin.y = recipe.origin.northing.value_or(median(northings));
  return result;
}

void write_tiles(SceneWriter& writer, MaterialTable& materials, TileStore& tiles,
                 const Georeference& georeference, const Terrain* hide_by, unsigned threads,
                 BakeReport& report, const ProgressSink& progress) {
  struct Tile {
    TileKey key;
    SceneMesh mesh;
    HiddenCounts hidden;
  };
  HiddenCounts hidden;
  const std::vector<TileKey> keys = tiles.tiles();
  std::size_t begun = 0, done = 0;
  const auto next = [&] {
    return begun < keys.size() ? std::optional(keys[begun++]) : std::nullopt;
  };
  const auto build = [&](const TileKey& key) {
    Tile tile{key, {}, {}};
    const glm::dvec3 corner = tiles.origin(key);
    const auto below = [&](const glm::vec3& p) {
      const auto ground =
          hide_by->height_of(Footing::terrain, {corner.x + double{p.x}, corner.y - double{p.z}});
      return ground && corner.z + double{p.y} < *ground - hidden_below_m;
    };
    const auto leave_out = [&](std::span<const TileStore::StoredTriangle> triangles) {
      return hidden_triangles(triangles, below, tile.hidden);
    };
    tile.mesh = tiles.mesh(key, hide_by ? TileStore::LeaveOut(leave_out) : TileStore::LeaveOut());
    return tile;
  };
  const auto write = [&](Tile&& tile) {
    hidden.between += tile.hidden.between;
    hidden.below += tile.hidden.below;
    SceneMesh& mesh = tile.mesh;
    if (mesh.primitives.empty()) return;
    for (ScenePrimitive& primitive : mesh.primitives) {
      const MaterialCode code = primitive.material;
      report.triangles[bake_materials()[static_cast<std::size_t>(kind_of(code))].name] +=
          primitive.indices.size() / 3;
      primitive.material = materials.index_of(code);
    }
    SceneInstance instance;
    instance.to_model[3] = glm::vec4(glm::vec3(georeference.to_model(tiles.origin(tile.key))), 1);
    writer.add_node({mesh.name, name_of(tile.key.kind), writer.add_mesh(mesh), true, {instance}});
    if (progress) progress({"writing tiles", ++done, "tiles"});
  };
  in_order(threads, next, build, write);
  if (hidden.between > 0) report.left_out["triangles between two buildings"] = hidden.between;
  if (hidden.below > 0) report.left_out["triangles of buildings below the ground"] = hidden.below;
}

}  // namespace

BakeReport bake(const Recipe& recipe, const std::filesystem::path& folder,
                const ProgressSink& progress) {
  BakeReport report;
  Stopwatch watch(report);
  for (const auto& file : recipe.city.files) report.input_bytes += size_of(file);
  OutputFolder output(
      folder);  // before the long work: an output that cannot be written is known at once
  const auto scene_path = output.staged("city.glb"), lights_path = output.staged("city.lights");

  // Small inputs first, so that their faults show before a large city has been read.
  const CityFrames frames(recipe);
  report.crs = frames.descriptions();
  OsmData osm = read_maps(recipe);
  watch.lap("reading maps");

  SceneWriter writer(scene_path, {recipe.output.draco, recipe.output.draco_tolerance_m});
  MaterialTable materials(writer);
  TileStore tiles(scene_path, recipe.city.tile_m, std::round(frames.reference().z));
  Terrain terrain(scene_path);
  DrapeStore drape(scene_path);
  std::optional<WindowLayout> windows;
  if (recipe.windows.lit) windows.emplace(window_options(recipe, osm, frames), lights_path);
  streets::RoadSurfaces roads;
  const bool model_streets = wants_model_streets(recipe, osm, frames);
  read_city(recipe, frames,
            {writer, tiles, drape, terrain, windows, model_streets ? &roads : nullptr}, report,
            progress);
  watch.lap("reading the city");
  if (model_streets) {
    report.streets = add_model_streets(roads, frames, osm);
    watch.lap("streets");
  }

  if (progress) progress({"building the terrain", 0, ""});
  report.ground = lay_ground(recipe, frames, terrain, tiles);
  report.draped = drape.lay(height_on(terrain), tiles);
  if (tiles.tiles().empty())
    throw Error(recipe.city.files.front().string(), "no surface in any file of the city");
  watch.lap("terrain");

  const Georeference georeference = georeference_amid(recipe, frames, tiles);
  write_tiles(writer, materials, tiles, georeference, recipe.city.drop_hidden ? &terrain : nullptr,
              recipe.city.read.threads, report, progress);
  report.colours = materials.colours();
  watch.lap("tiles");

  if (progress) progress({"placing lights", 0, ""});
  LightFileWriter lights(lights_path);
  const LampProfiles lamps = bake_lights(recipe, osm, frames, terrain, std::move(windows),
                                         georeference, writer, lights, lights_path, report);
  watch.lap("lights");

  traffic::TrafficSet traffic;
  if (recipe.traffic.drives) {
    traffic = make_city_traffic(recipe, osm, frames, terrain, georeference, progress);
    add_vehicle_models(writer, traffic, 3600 * 5 + 60 * recipe.night.minute);
    report.traffic = traffic.report;
    watch.lap("traffic");
  }
  finish_with_traffic(
      lights,
      {.georeference = georeference, .profiles = lamps.profiles, .profile_data = lamps.data},
      traffic);
  watch.lap("writing city.lights");

  writer.finish(georeference);
  report.scene = writer.statistics();
  report.scene_bytes = size_of(scene_path);
  report.lights_bytes = size_of(lights_path);
  watch.lap("writing city.glb");
  AtomicFile report_file(output.staged("bake_report.json"));
  report_file.write(to_json(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
                    "\n");
  report_file.commit();
  output.commit();
  return report;
}

}  // namespace nightcity
