#include "tools/mesh/polygon_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace nightcity::mesh {

glm::dvec2 Plane::flatten(const glm::dvec3& p) const {
  const glm::dvec3 d = p - origin;
  return {glm::dot(d, u), glm::dot(d, v)};
}

double Plane::distance(const glm::dvec3& p) const {
  return std::abs(glm::dot(p - origin, normal));
}

Plane make_plane(const glm::dvec3& origin, const glm::dvec3& unit_normal) {
  Plane plane;
  plane.origin = origin;
  plane.normal = unit_normal;
  const bool level = std::abs(unit_normal.z) > 0.999999;
  plane.u = level ? glm::normalize(glm::cross(glm::dvec3{0, 1, 0}, unit_normal))
                  : glm::normalize(glm::cross(glm::dvec3{0, 0, 1}, unit_normal));
  plane.v = glm::cross(unit_normal, plane.u);
  return plane;
}

bool has_duplicates(const city::Ring& ring) {
  if (ring.empty()) return false;
  return ring.back() == ring.front() || std::adjacent_find(ring.begin(), ring.end()) != ring.end();
}

city::Ring remove_duplicates(const city::Ring& ring) {
  city::Ring out;
  out.reserve(ring.size());
  for (const glm::dvec3& p : ring)
    if (out.empty() || p != out.back()) out.push_back(p);
  while (out.size() > 1 && out.back() == out.front()) out.pop_back();
  return out;
}

}  // namespace nightcity::mesh
