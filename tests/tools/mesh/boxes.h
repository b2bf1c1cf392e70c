// Boxes as buildings, for tests of shells.
#pragma once

#include <glm/geometric.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/mesh/polygon_plane.h"

namespace nightcity::test {

// Six faces outward, side `s`, corner at (x, y, z).
inline std::vector<city::Polygon> box(double x, double y, double z, double s) {
  const auto p = [&](int i, int j, int k) { return glm::dvec3{x + i * s, y + j * s, z + k * s}; };
  const std::vector<city::Ring> faces{{p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)},
                                      {p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)},
                                      {p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)},
                                      {p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)},
                                      {p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)},
                                      {p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1)}};
  std::vector<city::Polygon> out;
  for (const city::Ring& face : faces) {
    city::Polygon& polygon = out.emplace_back();
    polygon.exterior = face;
  }
  return out;
}

inline city::CityObject building(std::vector<city::Polygon> polygons) {
  city::CityObject object;
  object.id = "house";
  object.type = city::ObjectType::building;
  object.polygons = std::move(polygons);
  return object;
}

inline double volume(const city::CityObject& object) {
  double sum = 0;
  const glm::dvec3 origin = object.polygons.front().exterior.front();
  for (const city::Polygon& p : object.polygons) {
    glm::dvec3 area = city::area_vector(p.exterior);
    for (const city::Ring& hole : p.interiors) area += city::area_vector(hole);
    sum += glm::dot(area, p.exterior.front() - origin) / 3;
  }
  return sum;
}

}  // namespace nightcity::test
