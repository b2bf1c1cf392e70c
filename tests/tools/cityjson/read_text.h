// Reads CityJSON from a text.
#pragma once

#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/citygml/temporary_file.h"
#include "tools/city/ring.h"
#include "tools/cityjson/read_cityjson.h"

namespace nightcity::test {

struct ReadCity {
  std::vector<city::CityObject> objects;
  city::ReadReport report;
};

inline ReadCity read_city(const std::string& text, const city::ReadOptions& options = {}) {
  const TemporaryFile file(text, ".json");
  ReadCity result;
  const city::ObjectSink sink = [&](city::CityObject&& o) {
    result.objects.push_back(std::move(o));
  };
  result.report = cityjson::read_cityjson_staged(file.path(), options, city::deliver_to(sink));
  return result;
}

/// By the divergence theorem: a third of the sum of each face's area vector times a point of it.
inline double volume(const city::CityObject& object) {
  double sum = 0;
  const glm::dvec3 near = object.polygons.front().exterior.front();
  for (const city::Polygon& polygon : object.polygons)
    sum += glm::dot(city::area_vector(polygon.exterior), polygon.exterior.front() - near) / 3;
  return sum;
}

inline double area(const city::CityObject& object) {
  double sum = 0;
  for (const city::Polygon& polygon : object.polygons)
    sum += glm::length(city::area_vector(polygon.exterior));
  return sum;
}

}  // namespace nightcity::test
