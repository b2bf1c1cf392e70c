#include "tools/map_buildings/rectangle.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace nightcity::map_buildings {

Rectangle find_rectangle(const std::vector<glm::dvec2>& ring) {
  Rectangle best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    if (glm::length(edge) < 1e-6) continue;
    const glm::dvec2 u = glm::normalize(edge), v(-u.y, u.x);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec2& p : ring) {
      const glm::dvec2 q(glm::dot(p, u), glm::dot(p, v));
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
    const glm::dvec2 size = high - low, centre = (low + high) / 2.0;
    if (size.x * size.y >= least) continue;
    least = size.x * size.y;
    best.middle = centre.x * u + centre.y * v;
    const bool longer = size.x >= size.y;
    best.along = longer ? u : v;
    best.length = std::max(size.x, size.y);
    best.width = std::min(size.x, size.y);
  }
  return best;
}

}  // namespace nightcity::map_buildings
