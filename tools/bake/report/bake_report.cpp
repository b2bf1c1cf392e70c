#include "tools/bake/report/bake_report.h"

#include <fmt/format.h>

#include <algorithm>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/bake/report/layout_report.h"
#include "tools/bake/report/light_report.h"
#include "tools/bake/report/traffic_report.h"

namespace nightcity {
namespace {

using nlohmann::json;
using Counts = std::map<std::string, std::size_t>;

double total_seconds(const BakeReport& report) {
  double total = 0;
  for (const BakeReport::Stage& stage : report.stages) total += stage.seconds;
  return total;
}

std::size_t sum(const Counts& counts) {
  std::size_t total = 0;
  for (const auto& [name, count] : counts) total += count;
  return total;
}

std::string break_edges_in_words(const Terrain::BreakEdges& edges) {
  if (edges.used + edges.unused == 0) return {};
  return fmt::format(", {} edges of break lines kept, {} not, for they cross too many others",
                     edges.used, edges.unused);
}

}  // namespace

json to_json(const BakeReport& report) {
  json seconds = json::object(), peak_mb = json::object();
  for (const BakeReport::Stage& stage : report.stages) {
    seconds[stage.name] = std::round(stage.seconds * 1000) / 1000;
    peak_mb[stage.name] = std::round(stage.peak_mb);
  }
  const MeshReport& mesh = report.mesh;
  return {
      {"input_bytes", report.input_bytes},
      {"crs", report.crs},
      {"citygml",
       {{"version", report.read.version},
        {"objects", report.read.objects},
        {"polygons", report.read.polygons},
        {"objects_by_type", report.objects},
        {"left_out", report.left_out},
        {"skipped", report.read.skipped},
        {"warnings", report.read.warnings}}},
      {"mesh",
       {{"polygons", mesh.polygons},
        {"triangles", mesh.triangles},
        {"fast_path", mesh.fast_path},
        {"zero_area", mesh.zero_area},
        {"worst_zero_area",
         {{"id", mesh.worst_zero_area}, {"perimeter_m", mesh.worst_zero_area_m}}},
        {"slivers", mesh.slivers},
        {"worst_sliver", {{"id", mesh.worst_sliver}, {"width_m", mesh.worst_sliver_m}}},
        {"turned", mesh.turned},
        {"first_turned", mesh.first_turned},
        {"cracks_closed", mesh.cracks_closed},
        {"floors_added", mesh.floors_added},
        {"first_repaired", mesh.first_repaired},
        {"open_objects", mesh.open_objects},
        {"non_planar", mesh.non_planar},
        {"worst_non_planar", {{"id", mesh.worst_non_planar}, {"m", mesh.worst_non_planar_m}}},
        {"self_intersecting", mesh.self_intersecting},
        {"worst_self_intersecting",
         {{"id", mesh.worst_self_intersecting}, {"m2", mesh.worst_self_intersecting_m2}}},
        {"not_finite", mesh.not_finite},
        {"not_triangulated", mesh.not_triangulated},
        {"dropped_holes", mesh.dropped_holes}}},
      {"terrain", report.ground.source},
      {"dem", report.ground.dem},
      {"relief_points", report.relief_points},
      {"break_edges",
       {{"used", report.ground.break_edges.used}, {"unused", report.ground.break_edges.unused}}},
      {"colours", report.colours},
      {"draped_triangles", report.draped},
      {"streets", to_json(report.streets)},
      {"lamps", to_json(report.lamps)},
      {"layout", to_json(report.layout, true)},
      {"windows", to_json(report.windows)},
      {"traffic", report.traffic ? to_json(*report.traffic) : json()},
      {"scene",
       {{"meshes", report.scene.meshes},
        {"vertices", report.scene.vertices},
        {"triangles", report.scene.triangles},
        {"triangles_by_material", report.triangles},
        {"nodes", report.scene.nodes},
        {"instances", report.scene.instances},
        {"features", report.scene.features},
        {"bytes", report.scene_bytes},
        {"draco_bits", report.scene.max_draco_bits},
        {"draco_error_m", report.scene.max_draco_error_m}}},
      {"lights", {{"bytes", report.lights_bytes}, {"schedules", report.schedules}}},
      {"seconds", seconds},
      {"peak_mb", peak_mb},
  };
}

std::string to_text(const BakeReport& report) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<12}{}\n", name, value);
  };
  const MeshReport& mesh = report.mesh;
  for (const std::string& crs : report.crs) line("crs", crs);
  line("objects", in_words(report.objects));
  if (!report.left_out.empty()) line("left out", in_words(report.left_out));
  line("polygons", fmt::format("{} read, {} triangulated ({} at once)", report.read.polygons,
                               mesh.polygons, mesh.fast_path));
  if (mesh.non_planar)
    line("", fmt::format("{} not planar beyond 1 cm, worst {:.2f} m ({})", mesh.non_planar,
                         mesh.worst_non_planar_m, mesh.worst_non_planar));
  if (mesh.self_intersecting)
    line("", fmt::format("{} self-intersecting, worst {:.2f} m2 ({})", mesh.self_intersecting,
                         mesh.worst_self_intersecting_m2, mesh.worst_self_intersecting));
  if (mesh.slivers)
    line("", fmt::format("{} slivers under 1 cm, narrowest {:.5f} m ({})", mesh.slivers,
                         mesh.worst_sliver_m, mesh.worst_sliver));
  if (mesh.turned)
    line("", fmt::format("{} faced inward, turned (first {})", mesh.turned, mesh.first_turned));
  if (mesh.cracks_closed + mesh.floors_added)
    line("", fmt::format("{} objects had cracks closed, {} a floor added (first {})",
                         mesh.cracks_closed, mesh.floors_added, mesh.first_repaired));
  if (mesh.open_objects)
    line("", fmt::format("{} objects are no closed shells, as published", mesh.open_objects));
  if (const std::size_t dropped = mesh.zero_area + mesh.not_finite + mesh.not_triangulated)
    line("", fmt::format("{} dropped: {} without area{}, {} not finite, {} not triangulated",
                         dropped, mesh.zero_area,
                         mesh.zero_area ? fmt::format(" (longest {})", mesh.worst_zero_area) : "",
                         mesh.not_finite, mesh.not_triangulated));
  line("skipped", in_words(report.read.skipped));
  const auto& warnings = report.read.warnings;
  constexpr std::size_t shown = 3;
  for (std::size_t i = 0; i < std::min(shown, warnings.size()); ++i) line("warning", warnings[i]);
  if (warnings.size() > shown)
    line("", fmt::format("and {} more warnings in bake_report.json", warnings.size() - shown));
  line("triangles", fmt::format("{}: {}", sum(report.triangles), in_words(report.triangles)));
  line("terrain", report.ground.source + break_edges_in_words(report.ground.break_edges) +
                      (report.ground.dem.empty() ? "" : ", dem " + report.ground.dem) +
                      (report.draped ? fmt::format(", {} triangles without heights laid onto it",
                                                   report.draped)
                                     : ""));
  if (report.colours)
    line("colours", fmt::format("{} of the model's own materials", report.colours));
  text += to_text(report.streets);
  text += to_text(report.lamps);
  text += to_text(report.layout, false);
  text += to_text(report.windows);
  if (report.traffic) text += to_text(*report.traffic);
  const SceneWriter::Statistics& scene = report.scene;
  line("city.glb", fmt::format("{:.1f} MB, {} features, {} nodes, {} vertices",
                               static_cast<double>(report.scene_bytes) / 1e6, scene.features,
                               scene.nodes, scene.vertices));
  if (scene.max_draco_bits)
    line("", fmt::format("Draco: up to {} bits, worst displacement {:.4f} m", scene.max_draco_bits,
                         scene.max_draco_error_m));
  line("city.lights",
       fmt::format("{:.1f} kB, {} schedules", static_cast<double>(report.lights_bytes) / 1e3,
                   report.schedules));
  std::string stages;
  for (const BakeReport::Stage& stage : report.stages)
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", stage.name, stage.seconds);
  const double total = total_seconds(report);
  line("time", fmt::format("{:.1f} s ({:.1f} MB/s of CityGML): {}", total,
                           total > 0 ? static_cast<double>(report.input_bytes) / 1e6 / total : 0.0,
                           stages));
  if (!report.stages.empty())
    line("memory", fmt::format("{:.0f} MB at most", report.stages.back().peak_mb));
  return text;
}

}  // namespace nightcity
