#include <map>
#include <optional>

#include "formats/error.h"
#include "tools/georeference/frame.h"
#include "tools/inputs/read_city.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/triangulate.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {

Inspection inspect_city(const std::filesystem::path& file, const std::string& kind, int max_lod) {
  Inspection result = make_empty_inspection(kind);
  const city::CityHead head = inputs::read_city_head(file);
  // A file with an unknown CRS is inspected too; its coordinates are then taken as they are.
  std::optional<georeference::CityFrame> frame;
  std::string frame_error;
  try {
    frame = georeference::CityFrame::from_srs_name(head.srs_name, head.sample, {});
  } catch (const Error& error) {
    frame_error = error.what();
  }

  std::map<std::string, std::size_t> objects, lods;
  Bounds bounds;
  mesh::MeshReport mesh;
  std::size_t buildings = 0;
  std::string last_id;
  city::ReadOptions options;
  options.max_lod = max_lod;
  const city::ReadReport report = inputs::read_city(file, options, [&](city::CityObject&& object) {
    // Large objects come in pieces under one id.
    if (object.id.empty() || object.id != last_id) {
      ++objects[city::name_of(object.type)];
      ++lods[object.lod < 0 ? "none" : std::to_string(object.lod)];
      if (object.type == city::ObjectType::building) ++buildings;
    }
    last_id = object.id;
    for (city::Polygon& polygon : object.polygons) {
      if (frame) {
        frame->to_projected(polygon.exterior);
        for (city::Ring& ring : polygon.interiors) frame->to_projected(ring);
      }
      for (const glm::dvec3& p : polygon.exterior) bounds.add(p);
    }
    mesh::triangulate(object, mesh);
  });

  result["buildings"] = buildings;
  result["polygons"] = report.polygons;
  result["triangles"] = mesh.triangles;
  if (frame)
    result["crs"] = frame->crs();
  else if (!head.srs_name.empty())
    result["crs"] = head.srs_name;
  result["bbox"] = bounds.to_json(3);
  if (frame && frame->has_lon_lat() && !result["bbox"].is_null()) {
    Bounds degrees;  // of the four corners: exact enough to find the place on a map
    for (const double x : {bounds.min.x, bounds.max.x})
      for (const double y : {bounds.min.y, bounds.max.y})
        degrees.add(glm::dvec3(frame->to_lon_lat({x, y}), 0));
    result["bbox_wgs84"] = degrees.to_json(2);
  }
  for (const auto& [what, count] : report.skipped) result["skipped"][what] = count;
  result["version"] = report.version;
  result["srs_name"] = head.srs_name;
  result["crs_description"] = frame ? frame->description() : frame_error;
  result["objects"] = objects;
  result["lods"] = lods;
  result["mesh"] = {{"zero_area", mesh.zero_area},
                    {"slivers", mesh.slivers},
                    {"non_planar", mesh.non_planar},
                    {"worst_non_planar_m", mesh.worst_non_planar_m},
                    {"self_intersecting", mesh.self_intersecting},
                    {"holes_outside", mesh.holes_outside},
                    {"not_finite", mesh.not_finite},
                    {"not_triangulated", mesh.not_triangulated}};
  result["warnings"] = report.warnings;
  if (frame && !frame->axis_warning().empty())
    result["warnings"].push_back(file.string() + ": " + frame->axis_warning());
  if (!frame)
    result["warnings"].push_back(file.string() +
                                 ": coordinates are shown as they are in the file: " + frame_error);
  return result;
}

}  // namespace nightcity::nightbake
