#include "tools/mesh/classify.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

double find_lowest(const city::Ring& ring) {
  double z = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : ring) z = std::min(z, p.z);
  return z;
}

}  // namespace

void classify_unknown_surfaces(city::CityObject& object) {
  if (object.type != city::ObjectType::building && object.type != city::ObjectType::bridge) return;
  // A face counts as level when its slope is below 60 degrees: roofs may be steep, walls lean
  // little.
  constexpr double level_cosine = 0.5;
  double base = std::numeric_limits<double>::infinity(), top = -base;
  for (const city::Polygon& polygon : object.polygons) {
    for (const glm::dvec3& p : polygon.exterior) {
      base = std::min(base, p.z);
      top = std::max(top, p.z);
    }
  }
  for (city::Polygon& polygon : object.polygons) {
    if (polygon.surface != city::SurfaceType::unknown || polygon.exterior.size() < 3) continue;
    const glm::dvec3 area = city::area_vector(polygon.exterior);
    const double up = area.z / glm::length(area);
    if (!std::isfinite(up)) continue;
    if (std::abs(up) < level_cosine)
      polygon.surface = city::SurfaceType::wall;
    else if (up > 0 && find_lowest(polygon.exterior) - base > 0.1 * (top - base))
      polygon.surface = city::SurfaceType::roof;
    else if (up > 0)  // a footprint drawn face up, or a block without height
      polygon.surface = top > base ? city::SurfaceType::ground : city::SurfaceType::roof;
    else
      polygon.surface = find_lowest(polygon.exterior) - base > 0.1 * (top - base)
                            ? city::SurfaceType::outer_ceiling
                            : city::SurfaceType::ground;
  }
}

}  // namespace nightcity::mesh
