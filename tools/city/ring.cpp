#include "tools/city/ring.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

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

namespace {

// Returns whether a box lies within another: the boxes of two rings.
bool lies_within(const Ring& inner, const Ring& outer) {
  glm::dvec3 low = inner.front(), high = low, outer_low = outer.front(), outer_high = outer_low;
  for (const glm::dvec3& p : inner) low = glm::min(low, p), high = glm::max(high, p);
  for (const glm::dvec3& p : outer)
    outer_low = glm::min(outer_low, p), outer_high = glm::max(outer_high, p);
  return glm::all(glm::lessThanEqual(outer_low, low)) &&
         glm::all(glm::lessThanEqual(high, outer_high));
}

}  // namespace

bool set_outer_ring(Polygon& polygon) {
  if (polygon.exterior.empty()) return false;
  const glm::dvec3 own = area_vector(polygon.exterior);
  for (Ring& hole : polygon.interiors) {
    if (hole.empty()) continue;
    const glm::dvec3 its = area_vector(hole);
    if (!(glm::dot(its, its) > glm::dot(own, own)) || !lies_within(polygon.exterior, hole))
      continue;
    std::swap(polygon.exterior, hole);
    if (glm::dot(its, own) < 0) {  // the surface goes on facing the same way
      std::reverse(polygon.exterior.begin(), polygon.exterior.end());
      std::reverse(hole.begin(), hole.end());
    }
    return true;
  }
  return false;
}

}  // namespace nightcity::city
