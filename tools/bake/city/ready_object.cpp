#include "tools/bake/city/ready_object.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "formats/checksum.h"
#include "formats/finite.h"
#include "tools/bake/city/picture_budget.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/simplify_outlines.h"
#include "tools/mesh/triangulate.h"
#include "tools/terrain/thin_surface.h"

namespace nightcity::bake {
namespace {

std::uint64_t make_identity(const city::CityObject& object) {
  if (object.id.empty() || (object.polygons.empty() && !object.plant)) return 0;
  std::string key = object.id;
  const city::Ring& ring =
      object.polygons.empty() ? object.points : object.polygons.front().exterior;
  if (!ring.empty()) key.append(reinterpret_cast<const char*>(&ring.front()), sizeof(glm::dvec3));
  return checksum(key.data(), key.size());
}

std::uint64_t sum_outlines(const city::CityObject& object) {
  std::uint64_t sum = object.polygons.size();
  const auto add = [&](const city::Ring& ring) {
    sum = std::rotl(sum, 1) ^ checksum(ring.data(), ring.size() * sizeof(glm::dvec3));
  };
  for (const city::Polygon& polygon : object.polygons) {
    add(polygon.exterior);
    for (const city::Ring& hole : polygon.interiors) add(hole);
  }
  add(object.points);
  return sum;
}

void to_city_frame(const std::string* srs_name, std::size_t file, const CityFrames& frames,
                   std::span<glm::dvec3> coordinates,
                   const std::optional<glm::dvec3>& anchor = {}) {
  if (srs_name)
    frames.to_city(*srs_name, coordinates, anchor);
  else
    frames.to_city(file, coordinates, anchor);
}

// Returns the reference point of the shape whose place `point` is; none where no shape has one.
std::optional<glm::dvec3> find_anchor(const city::CityObject& object, const glm::dvec3& point) {
  std::optional<glm::dvec3> nearest;
  for (const city::Polygon& polygon : object.polygons)
    if (polygon.anchor &&
        (!nearest || glm::distance(*polygon.anchor, point) < glm::distance(*nearest, point)))
      nearest = polygon.anchor;
  return nearest;
}

void to_city_frame(city::CityObject& object, std::size_t file, const CityFrames& frames) {
  for (city::Polygon& polygon : object.polygons) {
    const std::string* name = polygon.srs_name.get();
    to_city_frame(name, file, frames, polygon.exterior, polygon.anchor);
    for (city::Ring& ring : polygon.interiors)
      to_city_frame(name, file, frames, ring, polygon.anchor);
  }
  const std::string* name = object.points_srs_name.get();
  // A tree has a place for each of its levels of detail.
  constexpr std::size_t most_places = 16;
  if (object.plant && object.points.size() <= most_places)
    for (glm::dvec3& point : object.points)
      to_city_frame(name, file, frames, std::span(&point, 1), find_anchor(object, point));
  else
    to_city_frame(name, file, frames, object.points);
  for (city::Ring& line : object.lines) to_city_frame(name, file, frames, line);
}

enum class Standing : std::uint8_t { on_ground, on_ground_near, nowhere };

Standing stand_on_ground(city::CityObject& object, const GroundHeights& heights) {
  std::vector<glm::dvec2> places;
  for (const city::Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior) places.emplace_back(p);
  const auto before = [](const glm::dvec2& a, const glm::dvec2& b) {
    return std::make_pair(a.x, a.y) < std::make_pair(b.x, b.y);
  };
  std::sort(places.begin(), places.end(), before);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  double lowest = std::numeric_limits<double>::infinity();
  for (const double height : heights.at(places))
    if (height < lowest) lowest = height;  // not NaN
  const bool is_known = std::isfinite(lowest);
  if (!is_known && !places.empty()) lowest = heights.near(places.front());
  if (!std::isfinite(lowest)) return Standing::nowhere;
  for (city::Polygon& polygon : object.polygons) {
    for (glm::dvec3& p : polygon.exterior) p.z += lowest;
    for (city::Ring& ring : polygon.interiors)
      for (glm::dvec3& p : ring) p.z += lowest;
  }
  return is_known ? Standing::on_ground : Standing::on_ground_near;
}

bool is_far_away(const city::CityObject& object, const CityFrames& frames) {
  const glm::dvec2 middle(frames.reference());
  for (const city::Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior)
      if (glm::distance(glm::dvec2(p), middle) > max_distance_m) return true;
  if (!object.plant) return false;
  return std::any_of(object.points.begin(), object.points.end(), [&](const glm::dvec3& p) {
    return !finite(p) || glm::distance(glm::dvec2(p), middle) > max_distance_m;
  });
}

// Triangles of several colours would lose them when they are thinned.
bool is_coloured(const city::CityObject& object) {
  return std::any_of(object.polygons.begin(), object.polygons.end(), [&](const auto& polygon) {
    return polygon.diffuse_colour != object.polygons.front().diffuse_colour ||
           polygon.surface != object.polygons.front().surface;
  });
}

void thin(mesh::TriangleMesh& ground, double max_error_m, mesh::MeshReport& report) {
  const std::size_t before = ground.triangles.size();
  ground = terrain::thin_surface(ground, max_error_m);
  report.triangles_thinned += before - ground.triangles.size();
}

// Returns why an object has no triangles.
Unusable find_cause(const mesh::MeshReport& report) {
  return report.too_many_points + report.crossing_too_often == report.polygons
             ? Unusable::beyond_limits
             : Unusable::without_area;
}

}  // namespace

void for_each_named(const city::CityObject& object,
                    const std::function<void(const std::string&, const city::Ring&)>& visit) {
  for (const city::Polygon& polygon : object.polygons)
    if (polygon.srs_name) visit(*polygon.srs_name, polygon.exterior);
  if (!object.points_srs_name) return;
  if (!object.points.empty()) visit(*object.points_srs_name, object.points);
  for (const city::Ring& line : object.lines) visit(*object.points_srs_name, line);
}

ReadySettings to_ready_settings(const CityInputs& inputs, const CityFrames& frames,
                                const GroundHeights* heights) {
  return {frames,
          heights,
          inputs.read.polygon,
          inputs.simplify_m,
          inputs.ground.max_error_m,
          inputs.texels_per_m,
          inputs.picture_budget.get(),
          inputs.drops_roads && !inputs.maps.empty()};
}

ReadyObject make_ready(city::CityObject&& object, std::size_t file, const ReadySettings& settings) {
  const CityFrames& frames = settings.frames;
  ReadyObject result;
  bool known = true;
  for_each_named(object, [&](const std::string& name, const city::Ring&) {
    result.elsewhere = name;
    known = known && frames.knows(name);
  });
  if (!known) {
    result.unknown = std::move(object);
    return result;
  }
  result.identity = make_identity(object);
  if (result.identity != 0) result.contents = sum_outlines(object);
  const auto prepared = std::make_shared<PreparedObject>();
  prepared->lacks_heights = lacks_heights(object);
  to_city_frame(object, file, frames);
  if (object.polygons.empty() && object.points.empty() && object.lines.empty()) {
    result.unusable = Unusable::without_geometry;
  } else if (settings.drops_roads && object.type == city::ObjectType::road) {
    result.unusable = Unusable::replaced_by_map;
  } else if (is_far_away(object, frames)) {
    result.unusable = Unusable::far_away;
  } else if (object.polygons.empty()) {
    // Points and lines alone have no mesh.
  } else if (const Standing standing = settings.heights ? stand_on_ground(object, *settings.heights)
                                                        : Standing::on_ground;
             standing == Standing::nowhere) {
    result.unusable = Unusable::without_ground;
  } else {
    result.beyond_heights = standing == Standing::on_ground_near;
    const PictureLayout pictures(object);
    prepared->pictured_polygons = pictures.size();
    if (object.type == city::ObjectType::building)
      result.report.corners_left_out += mesh::simplify_outlines(object, settings.simplify_m);
    // Shells first: which way is out decides what is a roof and which side of a wall has windows.
    mesh::repair_shells(object, result.report);
    mesh::classify_unknown_surfaces(object);
    prepared->mesh = mesh::triangulate(object, result.report, settings.polygon);
    if (object.type == city::ObjectType::relief && settings.max_error_m > 0 &&
        !is_coloured(object) && pictures.empty())
      thin(prepared->mesh, settings.max_error_m, result.report);
    if (!pictures.empty() && !(settings.picture_budget && settings.picture_budget->has_ended()))
      prepared->pictures = pictures.lay_out(prepared->mesh, object, settings.texels_per_m);
    if (prepared->mesh.triangles.empty()) result.unusable = find_cause(result.report);
  }
  prepared->tree = trees::find_model_tree(object, &prepared->no_tree);
  prepared->closed = object.type == city::ObjectType::building && result.report.open_objects == 0;
  for (city::Polygon& polygon : object.polygons) polygon.picture.reset();
  prepared->object = std::move(object);
  result.prepared = prepared;
  return result;
}

bool lacks_heights(const city::CityObject& object) {
  switch (object.type) {
    case city::ObjectType::road:
    case city::ObjectType::railway:
    case city::ObjectType::land_use:
    case city::ObjectType::water:
    case city::ObjectType::vegetation:
      break;
    default:
      return false;
  }
  for (const city::Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior)
      if (p.z != 0) return false;
  return true;
}

}  // namespace nightcity::bake
