#include "tools/map_buildings/centroid.h"

#include "tools/map_buildings/shell.h"

namespace nightcity::map_buildings {

std::optional<glm::dvec2> find_centroid(const std::vector<glm::dvec2>& ring) {
  double area = 0;
  glm::dvec2 sum{0};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double part = cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
    area += part;
    sum += part * (ring[i] + ring[i + 1] - 2.0 * ring[0]) / 3.0;
  }
  if (!(area > 1e-6)) return {};
  return ring[0] + sum / area;
}

bool sees_each_edge(const glm::dvec2& place, const std::vector<glm::dvec2>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (cross(ring[(i + 1) % ring.size()] - ring[i], place - ring[i]) <= 1e-6) return false;
  return true;
}

}  // namespace nightcity::map_buildings
