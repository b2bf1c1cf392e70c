// CityGML 2.0 text, one city object at a time.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tools/town/building_plan.h"
#include "tools/town/hills.h"
#include "tools/town/roads.h"
#include "tools/town/text_file.h"
#include "tools/town/town.h"
#include "tools/town/trees.h"

namespace nightcity::town {

class GmlWriter {
 public:
  /// Writes the head. `low` and `high` bound the city, m from `origin` (EPSG:25833, heights absolute).
  GmlWriter(TextFile& out, const glm::dvec2& origin, const glm::dvec3& low, const glm::dvec3& high);

  /// The square of terrain grid cells [x0, x1) x [y0, y1), as one TINRelief.
  void relief(const Hills& hills, int x0, int y0, int x1, int y1);
  void road(const RoadPlan& road);
  void building(const BuildingPlan& plan, std::uint64_t seed);
  void tree(const TreePlan& tree);
  void finish();  // closes the root element

  const TownCounts& counts() const { return counts_; }

 private:
  void surface(const std::string& id, const Polygon& polygon);
  void body(const BuildingPlan& plan, const std::string& id);
  void details(const BuildingPlan& plan, const std::string& id, std::uint64_t seed);
  void polygon(const Polygon& polygon, const std::string& id);
  void attributes(const BuildingPlan& plan, std::uint64_t seed);
  void ring(const Ring& ring);
  void position(const glm::dvec3& p);

  TextFile& out_;
  glm::dvec2 origin_;
  TownCounts counts_;
};

}  // namespace nightcity::town
