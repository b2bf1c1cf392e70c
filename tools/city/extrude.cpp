#include "tools/city/extrude.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "tools/city/ring.h"

namespace nightcity::city {
namespace {

bool is_footprint(const Polygon& polygon) {
  return polygon.surface != SurfaceType::roof;
}

// Footprints may follow the ground, and roof edges the roof: but they have an area in plan, which a
// wall has not. In degrees too, where slopes say nothing.
bool is_plan(const Polygon& polygon) {
  constexpr double least_share = 1e-3;  // of the area of the box around it
  const Ring& ring = polygon.exterior;
  if (ring.empty()) return false;
  glm::dvec3 low = ring.front(), high = low;
  for (const glm::dvec3& p : ring) low = glm::min(low, p), high = glm::max(high, p);
  const double area = std::abs(area_vector(ring).z);
  return area > 0 && area >= least_share * (high.x - low.x) * (high.y - low.y);
}

// Returns the height that stands for a plan: the lowest of a footprint, the highest of a roof edge.
double find_level(const Polygon& plan) {
  const auto [low, high] =
      std::minmax_element(plan.exterior.begin(), plan.exterior.end(),
                          [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; });
  return is_footprint(plan) ? low->z : high->z;
}

Ring at_height(Ring ring, double z) {
  for (glm::dvec3& p : ring) p.z = z;
  return ring;
}

// Turns the rings so that the outer one runs counter-clockwise in x, y and holes clockwise.
void turn_up(Polygon& polygon) {
  if (area_vector(polygon.exterior).z < 0)
    std::reverse(polygon.exterior.begin(), polygon.exterior.end());
  for (Ring& hole : polygon.interiors)
    if (area_vector(hole).z > 0) std::reverse(hole.begin(), hole.end());
}

void add_walls(const Ring& ring, double foot, double top, const Polygon& of,
               std::vector<Polygon>& out) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    Polygon wall;
    wall.surface = SurfaceType::wall;
    wall.diffuse_colour = of.diffuse_colour;
    wall.exterior = {{a.x, a.y, foot}, {b.x, b.y, foot}, {b.x, b.y, top}, {a.x, a.y, top}};
    out.push_back(std::move(wall));
  }
}

void add_block(Polygon plan, double height, std::vector<Polygon>& out) {
  const double z = find_level(plan);
  const bool hangs = plan.surface == SurfaceType::roof && z != 0;
  const double foot = hangs ? z - height : z, top = foot + height;
  turn_up(plan);
  Polygon roof = plan, floor = plan;
  roof.surface = SurfaceType::roof;
  floor.surface = SurfaceType::ground;
  if (!plan.id.empty()) floor.id = plan.id + "_floor";
  roof.exterior = at_height(roof.exterior, top);
  floor.exterior = at_height(floor.exterior, foot);
  std::reverse(floor.exterior.begin(), floor.exterior.end());
  for (Ring& hole : roof.interiors) hole = at_height(hole, top);
  for (Ring& hole : floor.interiors) {
    hole = at_height(hole, foot);
    std::reverse(hole.begin(), hole.end());
  }
  out.push_back(std::move(floor));
  out.push_back(std::move(roof));
  add_walls(plan.exterior, foot, top, plan, out);
  for (const Ring& hole : plan.interiors) add_walls(hole, foot, top, plan, out);
}

}  // namespace

bool is_flat_building(const CityObject& object) {
  return object.type == ObjectType::building && object.lod == 0 && !object.polygons.empty() &&
         std::all_of(object.polygons.begin(), object.polygons.end(),
                     [](const Polygon& polygon) { return is_plan(polygon); });
}

std::optional<double> find_block_height_m(const CityObject& object) {
  constexpr double storey_m = 3;
  if (object.measured_height_m) return object.measured_height_m;
  const std::vector<double>& stated = object.storey_heights_m;
  const double sum = std::accumulate(stated.begin(), stated.end(), 0.0);
  if (!object.storeys_above_ground) return stated.empty() ? std::nullopt : std::optional(sum);
  if (*object.storeys_above_ground <= 0) return {};
  const double mean = stated.empty() ? storey_m : sum / static_cast<double>(stated.size());
  return *object.storeys_above_ground * mean;
}

std::optional<double> find_roof_span(const CityObject& object) {
  std::optional<double> foot, top;
  for (const Polygon& polygon : object.polygons) {
    const double z = find_level(polygon);
    if (is_footprint(polygon))
      foot = std::min(foot.value_or(z), z);
    else
      top = std::max(top.value_or(z), z);
  }
  return foot && top && *top > *foot ? std::optional(*top - *foot) : std::nullopt;
}

bool extrude_flat_building(CityObject& object, double height_unit_m) {
  if (!is_flat_building(object)) return false;
  std::optional<double> height_m = object.measured_height_m;
  if (const auto span = find_roof_span(object); span && !height_m) height_m = *span * height_unit_m;
  if (!height_m) height_m = find_block_height_m(object);
  if (!height_m) return false;
  const bool footprints = std::any_of(object.polygons.begin(), object.polygons.end(), is_footprint);
  std::vector<Polygon> blocks;
  for (Polygon& plan : object.polygons)
    if (!footprints || is_footprint(plan)) {
      plan.picture.reset();  // it is no picture of the block's sides
      add_block(std::move(plan), *height_m / height_unit_m, blocks);
    }
  object.polygons = std::move(blocks);
  return true;
}

}  // namespace nightcity::city
