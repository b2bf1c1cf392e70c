#include "tools/bake/report/mesh_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {

nlohmann::json to_json(const mesh::MeshReport& mesh) {
  return {
      {"polygons", mesh.polygons},
      {"triangles", mesh.triangles},
      {"fast_path", mesh.fast_path},
      {"zero_area", mesh.zero_area},
      {"worst_zero_area", {{"id", mesh.worst_zero_area}, {"perimeter_m", mesh.worst_zero_area_m}}},
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
      {"crossing_too_often", mesh.crossing_too_often},
      {"dropped_holes", mesh.holes_left_out},
      {"dropped_corners", mesh.corners_left_out},
      {"thinned_triangles", mesh.triangles_thinned},
      {"holes_outside", mesh.holes_outside},
      {"worst_hole_outside",
       {{"id", mesh.worst_hole_outside}, {"m2", mesh.worst_hole_outside_m2}}}};
}

std::string to_text(const mesh::MeshReport& mesh) {
  std::string text;
  const auto line = [&text](const std::string& value) { text += report_line("", value); };
  if (mesh.non_planar)
    line(fmt::format("{} not planar beyond 1 cm, worst {:.2f} m ({})", mesh.non_planar,
                     mesh.worst_non_planar_m, mesh.worst_non_planar));
  if (mesh.self_intersecting)
    line(fmt::format("{} self-intersecting, worst {:.2f} m2 ({})", mesh.self_intersecting,
                     mesh.worst_self_intersecting_m2, mesh.worst_self_intersecting));
  if (mesh.holes_outside)
    line(
        fmt::format("{} holes reach outside their exterior ring, worst by {:.2f} m2 ({}): nothing "
                    "is cut out or added there",
                    mesh.holes_outside, mesh.worst_hole_outside_m2, mesh.worst_hole_outside));
  if (mesh.holes_left_out)
    line(fmt::format("{} holes left out: they have no area", mesh.holes_left_out));
  if (mesh.corners_left_out)
    line(
        fmt::format("{} corners of buildings left out: they lay on edges but for [city] simplify_m",
                    mesh.corners_left_out));
  if (mesh.triangles_thinned)
    line(fmt::format("{} triangles of relief fewer, by [terrain] max_error_m",
                     mesh.triangles_thinned));
  if (mesh.slivers)
    line(fmt::format("{} slivers under 1 cm, narrowest {:.5f} m ({})", mesh.slivers,
                     mesh.worst_sliver_m, mesh.worst_sliver));
  if (mesh.turned)
    line(fmt::format("{} faced inward, turned (first {})", mesh.turned, mesh.first_turned));
  if (mesh.cracks_closed + mesh.floors_added)
    line(fmt::format("{} objects had cracks closed, {} a floor added (first {})",
                     mesh.cracks_closed, mesh.floors_added, mesh.first_repaired));
  if (mesh.open_objects)
    line(fmt::format("{} objects are no closed shells, as published", mesh.open_objects));
  if (const std::size_t left_out = mesh.zero_area + mesh.not_finite + mesh.not_triangulated)
    line(fmt::format("{} left out: {} without area{}, {} not finite, {} not triangulated", left_out,
                     mesh.zero_area,
                     mesh.zero_area ? fmt::format(" (longest {})", mesh.worst_zero_area) : "",
                     mesh.not_finite, mesh.not_triangulated));
  if (mesh.crossing_too_often)
    line(fmt::format(
        "{} of those not triangulated: outlines that cross more than [city] max_crossings allows",
        mesh.crossing_too_often));
  if (mesh.too_many_points)
    line(fmt::format(
        "{} of those not triangulated: more points than [city] max_polygon_points allows",
        mesh.too_many_points));
  return text;
}

}  // namespace nightcity::bake
