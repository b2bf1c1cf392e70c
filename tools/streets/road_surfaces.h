// Collects the surfaces of a city model that vehicles drive on, while it is read.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::streets {

using PlanRing = std::vector<glm::dvec2>;  // E, N in metres

struct RoadSurface {
  PlanRing exterior;
  std::vector<PlanRing> interiors;
  const char* highway = nullptr;  // value of OSM's tag by the model's codes; null: unknown
  bool carriageway = false;  // a carriageway only; otherwise the whole street with its pavements
};

/// Returns the value of OSM's `highway` for a road's function code (CityGML 2.0's list with four
/// digits, PLATEAU's with one); null if the code does not determine a class.
const char* highway_of(std::string_view function);

class RoadSurfaces {
 public:
  /// Adds the surfaces of a road, in the city's frame; other objects have none. Takes carriageways
  /// where the traffic areas say what they are, otherwise all areas that are not for other users.
  /// Upright and broken polygons are left out.
  void add(const city::CityObject& object);

  const std::vector<RoadSurface>& surfaces() const { return surfaces_; }
  /// Number of polygons left out, by reason.
  const std::map<std::string, std::size_t>& left_out() const { return left_out_; }

 private:
  std::vector<RoadSurface> surfaces_;
  std::map<std::string, std::size_t> left_out_;
};

}  // namespace nightcity::streets
