#include "tools/city/ring.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace nightcity::city {

glm::dvec3 area_vector(const Ring& ring) {
  glm::dvec3 sum{0};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return 0.5 * sum;
}

std::size_t count_vertices(const Polygon& polygon) {
  std::size_t count = polygon.exterior.size();
  for (const Ring& ring : polygon.interiors) count += ring.size();
  return count;
}

bool has_sentinel_height(const Polygon& polygon) {
  const auto holds = [](const Ring& ring) {
    return std::any_of(ring.begin(), ring.end(),
                       [](const glm::dvec3& p) { return is_sentinel_height(p.z); });
  };
  return holds(polygon.exterior) ||
         std::any_of(polygon.interiors.begin(), polygon.interiors.end(), holds);
}

}  // namespace nightcity::city
