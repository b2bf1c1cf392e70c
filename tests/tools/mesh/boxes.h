// Boxes as buildings, for tests of shells.
#pragma once

#include <glm/geometric.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/mesh/polygon_plane.h"

namespace nightcity::test {

// Six faces outward, side `s`, corner at (x, y, z).
inline std::vector<Polygon> box(double x, double y, double z, double s) {
  const auto p = [&](int i, int j, int k) { return glm::dvec3{x + i * s, y + j * s, z + k * s}; };
  const std::vector<Ring> faces{{p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)},
                                {p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)},
                                {p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)},
                                {p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)},
                                {p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)},
                                {p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1)}};
  std::vector<Polygon> out;
  for (const Ring& face : faces) {
    Polygon& polygon = out.emplace_back();
    polygon.exterior = face;
  }
  return out;
}

inline CityObject building(std::vector<Polygon> polygons) {
  CityObject object;
  object.id = "house";
  object.type = ObjectType::building;
  object.polygons = std::move(polygons);
  return object;
}

inline double volume(const CityObject& object) {
  double sum = 0;
  const glm::dvec3 origin = object.polygons.front().exterior.front();
  for (const Polygon& p : object.polygons) {
    glm::dvec3 area = area_vector(p.exterior);
    for (const Ring& hole : p.interiors) area += area_vector(hole);
    sum += glm::dot(area, p.exterior.front() - origin) / 3;
  }
  return sum;
}

}  // namespace nightcity::test
