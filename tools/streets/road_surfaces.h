// The surfaces of a city model that vehicles drive on, gathered while it is read.
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
  const char* highway = nullptr;  // value of OSM's tag, by the model's codes; null: nobody says
  bool carriageway = false;       // else the whole street, its pavements too
};

/// OSM's `highway` for a road's function code (CityGML 2.0's list with four digits, PLATEAU's with one); null
/// where the code tells nothing of the class.
const char* highway_of(std::string_view function);

class RoadSurfaces {
 public:
  /// Takes the surfaces of a road (other objects have none), in the city's frame: carriageways where its
  /// traffic areas say what they are, else all that is not said to be for other users. Upright and broken
  /// polygons carry nobody.
  void add(const CityObject& object);

  const std::vector<RoadSurface>& surfaces() const { return surfaces_; }
  /// Polygons by the reason for which they were not taken.
  const std::map<std::string, std::size_t>& left_out() const { return left_out_; }

 private:
  std::vector<RoadSurface> surfaces_;
  std::map<std::string, std::size_t> left_out_;
};

}  // namespace nightcity::streets
