#include "tools/bake/bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "tools/bake/city_frames.h"
#include "tools/bake/city_ground.h"
#include "tools/bake/city_stage.h"
#include "tools/bake/ground_stage.h"
#include "tools/bake/lamp_stage.h"
#include "tools/bake/light_stage.h"
#include "tools/bake/materials.h"
#include "tools/bake/output_folder.h"
#include "tools/bake/tile_store.h"
#include "tools/bake/traffic_stage.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(BakeReport& report) : report_(report) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    report_.seconds.emplace_back(stage, std::chrono::duration<double>(now - start_).count());
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
Georeference georeference_amid(const Recipe& recipe, const CityFrames& frames, const TileStore& tiles) {
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
                 const Georeference& georeference, BakeReport& report, const ProgressSink& progress) {
  std::size_t done = 0;
  for (const TileKey& key : tiles.tiles()) {
    SceneMesh mesh = tiles.mesh(key);
    if (mesh.primitives.empty()) continue;
    for (ScenePrimitive& primitive : mesh.primitives) {
      const MaterialCode code = primitive.material;
      report.triangles[bake_materials()[static_cast<std::size_t>(kind_of(code))].name] +=
          primitive.indices.size() / 3;
      primitive.material = materials.index_of(code);
    }
    SceneInstance instance;
    instance.to_model[3] = glm::vec4(glm::vec3(georeference.to_model(tiles.origin(key))), 1);
    writer.add_node({mesh.name, name_of(key.kind), writer.add_mesh(mesh), true, {instance}});
    if (progress) progress({"writing tiles", ++done, "tiles"});
  }
}

}  // namespace

BakeReport bake(const Recipe& recipe, const std::filesystem::path& folder, const ProgressSink& progress) {
  BakeReport report;
  Stopwatch watch(report);
  for (const auto& file : recipe.city.files) report.input_bytes += size_of(file);
  OutputFolder output(folder);  // before the long work: an output that cannot be written is known at once
  const auto scene_path = output.staged("city.glb"), lights_path = output.staged("city.lights");

  // Small inputs first, so that their faults show before a large city has been read.
  const CityFrames frames(recipe);
  report.crs = frames.descriptions();
  const OsmData osm = read_maps(recipe);
  watch.lap("reading maps");

  SceneWriter writer(scene_path, {recipe.output.draco, recipe.output.draco_tolerance_m});
  MaterialTable materials(writer);
  TileStore tiles(scene_path, recipe.city.tile_m, std::round(frames.reference().z));
  Terrain terrain(scene_path);
  DrapeStore drape(scene_path);
  std::optional<WindowLayout> windows;
  if (recipe.windows.lit) windows.emplace(window_options(recipe, osm, frames), lights_path);
  read_city(recipe, frames, {writer, tiles, drape, terrain, windows}, report, progress);
  watch.lap("reading the city");

  if (progress) progress({"building the terrain", 0, ""});
  report.ground = lay_ground(recipe, frames, terrain, tiles);
  report.draped = drape.lay(height_on(terrain), tiles);
  if (tiles.tiles().empty())
    throw Error(recipe.city.files.front().string(), "no surface in any file of the city");
  watch.lap("terrain");

  const Georeference georeference = georeference_amid(recipe, frames, tiles);
  write_tiles(writer, materials, tiles, georeference, report, progress);
  report.colours = materials.colours();
  watch.lap("tiles");

  if (progress) progress({"placing lights", 0, ""});
  bake_lights(recipe, osm, frames, terrain, std::move(windows), georeference, writer, lights_path, report);
  watch.lap("lights");

  if (recipe.traffic.drives) {
    const auto traffic = make_city_traffic(recipe, osm, frames, terrain, georeference, progress);
    write_with_traffic(lights_path, content_of(LightFile::open(lights_path)), traffic);
    add_vehicle_models(writer, traffic, 3600 * 5 + 60 * recipe.night.minute);
    report.traffic = traffic.report;
    watch.lap("traffic");
  }

  writer.finish(georeference);
  report.scene = writer.statistics();
  report.scene_bytes = size_of(scene_path);
  report.lights_bytes = size_of(lights_path);
  watch.lap("writing city.glb");
  AtomicFile report_file(output.staged("bake_report.json"));
  report_file.write(to_json(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  report_file.commit();
  output.commit();
  return report;
}

}  // namespace nightcity
