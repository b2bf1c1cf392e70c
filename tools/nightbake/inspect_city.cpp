#include <cmath>
#include <map>
#include <optional>

#include "formats/error.h"
#include "tools/georeference/frame.h"
#include "tools/inputs/read_city.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/triangulate.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {
namespace {

// Brings geometry that names another CRS than the file's first into the frame of that one.
class OtherFrames {
 public:
  explicit OtherFrames(const std::optional<georeference::CityFrame>& first) : first_(first) {}

  // Returns false where one of the two frames is unknown; then the coordinates stay.
  bool to_first(const std::string& srs_name, city::Ring& ring,
                const std::optional<glm::dvec3>& anchor) {
    auto found = frames_.find(srs_name);
    if (found == frames_.end()) found = frames_.emplace(srs_name, make_frame(srs_name, ring)).first;
    ++rings_[srs_name];
    const auto& frame = found->second;
    if (!frame || !first_ || !frame->has_lon_lat() || !first_->has_lon_lat()) return false;
    frame->to_projected(ring, anchor);
    for (glm::dvec3& p : ring)
      p = glm::dvec3(first_->from_lon_lat(frame->to_lon_lat(glm::dvec2(p))), p.z);
    return true;
  }

  const std::map<std::string, std::size_t>& rings() const { return rings_; }

 private:
  static std::optional<georeference::CityFrame> make_frame(const std::string& srs_name,
                                                           city::Ring ring) {
    if (!ring.empty()) ring.push_back(ring.front());
    try {
      return georeference::CityFrame::from_srs_name(srs_name, ring, {});
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  const std::optional<georeference::CityFrame>& first_;
  std::map<std::string, std::optional<georeference::CityFrame>> frames_;
  std::map<std::string, std::size_t> rings_;
};

}  // namespace

namespace {

// Longitudes of one place are counted on where they pass 180 degrees.
void add_corner(glm::dvec2 lon_lat, Bounds& degrees) {
  if (degrees.min.x <= degrees.max.x)
    lon_lat.x -= 360 * std::round((lon_lat.x - degrees.min.x) / 360);
  degrees.add(glm::dvec3(lon_lat, 0));
}

}  // namespace

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
  city::ReadOptions options;
  options.max_lod = max_lod;
  options.srs_name = head.srs_name;
  if (frame) options.height_unit_m = frame->height_unit_m();
  OtherFrames others(frame);
  const city::ReadReport report = inputs::read_city(file, options, [&](city::CityObject&& object) {
    if (!object.continues) {
      ++objects[city::name_of(object.type)];
      ++lods[object.lod < 0 ? "none" : std::to_string(object.lod)];
      if (object.type == city::ObjectType::building) ++buildings;
    }
    for (city::Polygon& polygon : object.polygons) {
      if (polygon.srs_name) {
        if (!others.to_first(*polygon.srs_name, polygon.exterior, polygon.anchor)) continue;
        for (city::Ring& ring : polygon.interiors)
          others.to_first(*polygon.srs_name, ring, polygon.anchor);
      } else if (frame) {
        frame->to_projected(polygon.exterior, polygon.anchor);
        for (city::Ring& ring : polygon.interiors) frame->to_projected(ring, polygon.anchor);
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
        add_corner(frame->to_lon_lat({x, y}), degrees);
    Inspection& box = result["bbox_wgs84"] = degrees.to_json(2);
    // Across the antimeridian west is greater than east (RFC 7946, section 5.2).
    if (degrees.max.x > 180) box[2] = degrees.max.x - 360;
    if (degrees.min.x < -180) box[0] = degrees.min.x + 360;
  }
  for (const auto& [what, count] : report.skipped) result["skipped"][what] = count;
  result["passed_over"] = report.passed_over;
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
  for (const auto& [name, count] : others.rings())
    result["warnings"].push_back(file.string() + ": " + std::to_string(count) +
                                 " outlines name another CRS (" + name +
                                 ") than the first geometry (" + head.srs_name + ")");
  if (frame && !frame->axis_warning().empty())
    result["warnings"].push_back(file.string() + ": " + frame->axis_warning());
  if (!frame)
    result["warnings"].push_back(file.string() +
                                 ": coordinates are shown as they are in the file: " + frame_error);
  return result;
}

}  // namespace nightcity::nightbake
