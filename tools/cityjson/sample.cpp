#include "tools/cityjson/sample.h"

#include <algorithm>
#include <limits>

#include "formats/finite.h"
#include "tools/cityjson/geometry_reader.h"

namespace nightcity::cityjson {

void Sample::add_object(const dom::element& element) {
  dom::object object;
  if (element.get(object) != simdjson::SUCCESS) return;
  const auto geometries = find_array(object, "geometry");
  if (!geometries) return;
  for (const dom::element& one : *geometries) {
    dom::object geometry;
    if (is_full() || one.get(geometry) != simdjson::SUCCESS) continue;
    const auto boundaries = find_member(geometry, "boundaries");
    if (!boundaries) continue;
    const std::size_t before = rings_.size();
    list_rings(*boundaries, rings_);
    for (std::size_t i = before; i < rings_.size(); ++i) points_ += rings_[i].size();
  }
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = coordinates_.size(); i < rings_.size(); ++i) {
    coordinates_.emplace_back(rings_[i].size(), glm::dvec3(unknown));
    missing_ += rings_[i].size();
  }
}

void Sample::take_vertices(std::span<const glm::dvec3> vertices, std::size_t first) {
  for (std::size_t i = 0; i < rings_.size(); ++i)
    for (std::size_t k = 0; k < rings_[i].size(); ++k) {
      const std::size_t number = rings_[i][k];
      if (number < first || number - first >= vertices.size()) continue;
      coordinates_[i][k] = vertices[number - first];
      --missing_;
    }
}

void Sample::move_to(city::CityHead& head) {
  for (const std::vector<glm::dvec3>& ring : coordinates_) {
    if (!std::all_of(ring.begin(), ring.end(), [](const glm::dvec3& p) { return finite(p); }))
      continue;
    head.sample.insert(head.sample.end(), ring.begin(), ring.end());
    head.sample.push_back(ring.front());
  }
  *this = {};
}

}  // namespace nightcity::cityjson
