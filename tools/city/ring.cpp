#include "tools/city/ring.h"

#include <glm/geometric.hpp>

namespace nightcity::city {

glm::dvec3 area_vector(const Ring& ring) {
  glm::dvec3 sum{0};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return 0.5 * sum;
}

}  // namespace nightcity::city
