#include "tools/bake/report/bake_report.h"

#include <fmt/format.h>

#include <algorithm>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/bake/report/layout_report.h"
#include "tools/bake/report/light_report.h"
#include "tools/bake/report/mesh_report.h"
#include "tools/bake/report/report_text.h"
#include "tools/bake/report/traffic_report.h"

namespace nightcity::bake {
namespace {

using nlohmann::json;
using Counts = std::map<std::string, std::size_t>;

double total_seconds(const BakeReport& report) {
  double total = 0;
  for (const StageCost& stage : report.stages) total += stage.seconds;
  return total;
}

std::size_t sum(const Counts& counts) {
  std::size_t total = 0;
  for (const auto& [name, count] : counts) total += count;
  return total;
}

std::string break_edges_in_words(const terrain::Terrain::BreakEdges& edges) {
  if (edges.used + edges.unused == 0) return {};
  return fmt::format(", {} edges of break lines kept, {} not, because they cross too many others",
                     edges.used, edges.unused);
}

std::string reading_in_words(const BakeReport& report) {
  std::string text;
  const CityReport& city = report.city;
  for (const std::string& crs : report.crs) text += report_line("crs", crs);
  text += report_line("objects", in_words(city.objects));
  if (const Counts left_out = report.left_out(); !left_out.empty())
    text += report_line("left out", in_words(left_out));
  text += report_line("polygons",
                      fmt::format("{} read, {} triangulated ({} at once)", city.read.polygons,
                                  city.mesh.polygons, city.mesh.fast_path));
  text += to_text(city.mesh);
  text += report_line("skipped", in_words(city.read.skipped));
  if (!city.read.assumed.empty()) text += report_line("assumed", in_words(city.read.assumed));
  if (!city.read.passed_over.empty())
    text += report_line("passed over", "files in archives: " + in_words(city.read.passed_over));
  const auto& warnings = city.read.warnings;
  constexpr std::size_t shown = 3;
  for (std::size_t i = 0; i < std::min(shown, warnings.size()); ++i)
    text += report_line("warning", warnings[i]);
  if (warnings.size() > shown)
    text += report_line(
        "", fmt::format("and {} more warnings in bake_report.json", warnings.size() - shown));
  return text;
}

std::string surfaces_in_words(const BakeReport& report) {
  const SceneTilesReport& tiles = report.tiles;
  const GroundReport& ground = report.ground;
  const std::size_t beyond = report.city.beyond_heights;
  std::string text = report_line(
      "triangles", fmt::format("{}: {}", sum(tiles.triangles), in_words(tiles.triangles)));
  text += report_line(
      "terrain",
      ground.source + break_edges_in_words(ground.break_edges) +
          (ground.beyond_relief_percent > 0
               ? fmt::format(", and made for the {:.1f} % of the buildings' corners beyond it",
                             ground.beyond_relief_percent)
               : "") +
          (ground.dem.empty() ? "" : ", dem " + ground.dem) +
          (beyond
               ? fmt::format(", {} buildings beyond its data stand as high as the nearest", beyond)
               : "") +
          (tiles.draped ? fmt::format(", {} triangles without heights put onto it", tiles.draped)
                        : ""));
  if (report.horizon.triangles > 0)
    text += report_line("horizon",
                        fmt::format("{} triangles around the ground", report.horizon.triangles));
  if (!report.horizon.left_out.empty())
    text += report_line("horizon", "left out: " + report.horizon.left_out);
  if (tiles.colours)
    text += report_line("colours", fmt::format("{} of the model's own materials", tiles.colours));
  if (const TextureReport& t = tiles.textures; t.pictures)
    text += report_line("textures",
                        fmt::format("{} surfaces in {} pictures: {:.1f} megatexels, {:.1f} MB",
                                    t.surfaces, t.pictures, static_cast<double>(t.texels) / 1e6,
                                    static_cast<double>(t.bytes) / 1e6));
  if (const std::size_t beyond = tiles.textures.beyond_limit; beyond > 0)
    text += report_line("textures",
                        fmt::format("{} surfaces have the mean colour: they are beyond [city] "
                                    "max_picture_mpx",
                                    beyond));
  return text + to_text(tiles.skins);
}

std::string gaps_in_words(const GapReport& gaps) {
  if (gaps.buildings == 0 && gaps.left_out.empty()) return {};
  std::string text = report_line(
      "gaps", fmt::format("{} buildings of the map where the model has none", gaps.buildings));
  if (!gaps.left_out.empty()) text += report_line("", "left out: " + in_words(gaps.left_out));
  if (!gaps.assumed.empty()) text += report_line("", "assumed: " + in_words(gaps.assumed));
  return text;
}

std::string outputs_in_words(const BakeReport& report) {
  const SceneWriter::Statistics& scene = report.scene;
  std::string text =
      report_line("city.glb", fmt::format("{:.1f} MB, {} features, {} nodes, {} vertices",
                                          static_cast<double>(report.scene_bytes) / 1e6,
                                          scene.features, scene.nodes, scene.vertices));
  if (scene.max_draco_bits)
    text += report_line("", fmt::format("Draco: up to {} bits, worst displacement {:.4f} m",
                                        scene.max_draco_bits, scene.max_draco_error_m));
  if (const HierarchyReport& hierarchies = report.hierarchies; hierarchies.triangles > 0)
    text += report_line(
        "", fmt::format("hierarchies of {} triangles: {} nodes, {:.1f} MB", hierarchies.triangles,
                        hierarchies.nodes, static_cast<double>(hierarchies.bytes) / 1e6));
  return text +
         report_line("city.lights", fmt::format("{:.1f} kB, {} schedules",
                                                static_cast<double>(report.lights_bytes) / 1e3,
                                                report.lights.schedules));
}

std::string costs_in_words(const BakeReport& report) {
  std::string stages;
  for (const StageCost& stage : report.stages)
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", stage.name, stage.seconds);
  const double total = total_seconds(report);
  std::string text = report_line(
      "time",
      fmt::format("{:.1f} s ({:.1f} MB/s of the model): {}", total,
                  total > 0 ? static_cast<double>(report.input_bytes) / 1e6 / total : 0.0, stages));
  if (!report.stages.empty())
    text += report_line("memory", fmt::format("{:.0f} MB at most", report.stages.back().peak_mb));
  return text;
}

}  // namespace

std::map<std::string, std::size_t> BakeReport::left_out() const {
  Counts all = city.left_out;
  for (const auto& [reason, count] : tiles.left_out) all[reason] += count;
  if (ground.lone_vertices > 0)
    all["break lines of which the vertices alone are used"] = ground.lone_vertices;
  return all;
}

json to_json(const BakeReport& report) {
  json seconds = json::object(), peak_mb = json::object();
  for (const StageCost& stage : report.stages) {
    seconds[stage.name] = std::round(stage.seconds * 1000) / 1000;
    peak_mb[stage.name] = std::round(stage.peak_mb);
  }
  const CityReport& city = report.city;
  const GroundReport& ground = report.ground;
  const SceneWriter::Statistics& scene = report.scene;
  return {
      {"input_bytes", report.input_bytes},
      {"crs", report.crs},
      {"citygml",
       {{"version", city.read.version},
        {"objects", city.read.objects},
        {"polygons", city.read.polygons},
        {"objects_by_type", city.objects},
        {"left_out", report.left_out()},
        {"skipped", city.read.skipped},
        {"assumed", city.read.assumed},
        {"passed_over", city.read.passed_over},
        {"warnings", city.read.warnings}}},
      {"mesh", to_json(city.mesh)},
      {"terrain", ground.source},
      {"dem", ground.dem},
      {"beyond_dem", city.beyond_heights},
      {"beyond_relief_percent", ground.beyond_relief_percent},
      {"relief_points", ground.relief_points},
      {"break_edges", {{"used", ground.break_edges.used}, {"unused", ground.break_edges.unused}}},
      {"horizon",
       {{"rings", report.horizon.rings},
        {"triangles", report.horizon.triangles},
        {"left_out", report.horizon.left_out}}},
      {"colours", report.tiles.colours},
      {"textures",
       {{"surfaces", report.tiles.textures.surfaces},
        {"triangles", report.tiles.textures.triangles},
        {"pictures", report.tiles.textures.pictures},
        {"texels", report.tiles.textures.texels},
        {"bytes", report.tiles.textures.bytes},
        {"beyond_limit", report.tiles.textures.beyond_limit}}},
      {"skins", to_json(report.tiles.skins)},
      {"draped_triangles", report.tiles.draped},
      {"gaps",
       {{"buildings_of_the_map", report.gaps.buildings},
        {"left_out", report.gaps.left_out},
        {"assumed", report.gaps.assumed}}},
      {"map", {{"skipped", report.skipped_of_map}}},
      {"bridges", to_json(report.bridges)},
      {"barriers", to_json(report.barriers)},
      {"steps", to_json(report.steps)},
      {"trees", to_json(report.trees)},
      {"ground_cover", to_json(report.cover, report.tiles)},
      {"streets", to_json(report.streets)},
      {"places", to_json(report.places)},
      {"lamps", to_json(report.lights.lamps)},
      {"layout", to_json(report.lights.layout, true)},
      {"map_lights", to_json(report.lights.map_lights)},
      {"windows", to_json(report.lights.windows)},
      {"traffic", report.traffic ? to_json(*report.traffic) : json()},
      {"scene",
       {{"meshes", scene.meshes},
        {"vertices", scene.vertices},
        {"triangles", scene.triangles},
        {"triangles_by_material", report.tiles.triangles},
        {"nodes", scene.nodes},
        {"instances", scene.instances},
        {"features", scene.features},
        {"bytes", report.scene_bytes},
        {"draco_bits", scene.max_draco_bits},
        {"draco_error_m", scene.max_draco_error_m},
        {"hierarchies",
         {{"triangles", report.hierarchies.triangles},
          {"nodes", report.hierarchies.nodes},
          {"bytes", report.hierarchies.bytes}}}}},
      {"lights", {{"bytes", report.lights_bytes}, {"schedules", report.lights.schedules}}},
      {"seconds", seconds},
      {"peak_mb", peak_mb},
  };
}

std::string to_text(const BakeReport& report) {
  std::string text = reading_in_words(report) + surfaces_in_words(report);
  text += gaps_in_words(report.gaps);
  text += to_text(report.cover, report.tiles);
  text += to_text(report.bridges);
  text += to_text(report.barriers);
  text += to_text(report.steps);
  text += to_text(report.trees);
  text += to_text(report.streets);
  text += to_text(report.places);
  text += to_text(report.lights.lamps);
  text += to_text(report.lights.layout, false);
  text += to_text(report.lights.map_lights);
  text += to_text(report.lights.windows);
  if (report.traffic) text += to_text(*report.traffic);
  return text + outputs_in_words(report) + costs_in_words(report);
}

}  // namespace nightcity::bake
