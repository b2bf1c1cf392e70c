// Reads CityJSON from a text.
#pragma once

#include <glm/geometric.hpp>
#include <string>

#include "formats/error.h"
#include "tests/tools/city/read_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/city/ring.h"
#include "tools/cityjson/read_cityjson.h"

namespace nightcity::test {

inline City read_city(const std::string& text, const city::ReadOptions& options = {}) {
  const TemporaryFile file(text, ".json");
  City city;
  const city::ObjectSink sink = city.sink();
  city.report = cityjson::read_cityjson_staged(file.path(), options, city::deliver_to(sink));
  return city;
}

/// Returns the message with which a text is refused, or "read".
inline std::string error_of(const std::string& text) {
  try {
    read_city(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
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
