// Writes CityGML 2.0, one city object at a time.
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
  /// Writes the head. `low` and `high` bound the city, m from `origin` (EPSG:25833, heights
  /// absolute).
  GmlWriter(TextFile& out, const glm::dvec2& origin, const glm::dvec3& low, const glm::dvec3& high);

  /// Writes the square of terrain grid cells [x0, x1) x [y0, y1) as one TINRelief.
  void write_relief(const Hills& hills, int x0, int y0, int x1, int y1);
  void write_road(const RoadPlan& road);
  void write_building(const BuildingPlan& plan, std::uint64_t seed);
  void write_tree(const TreePlan& tree);
  void finish();  // closes the root element

  const TownCounts& counts() const { return counts_; }

 private:
  void write_surface(const std::string& id, const city::Polygon& polygon);
  void write_body(const BuildingPlan& plan, const std::string& id);
  void write_details(const BuildingPlan& plan, const std::string& id, std::uint64_t seed);
  void write_polygon(const city::Polygon& polygon, const std::string& id);
  void write_attributes(const BuildingPlan& plan, std::uint64_t seed);
  void write_ring(const city::Ring& ring);
  void write_position(const glm::dvec3& p);

  TextFile& out_;
  glm::dvec2 origin_;
  TownCounts counts_;
};

}  // namespace nightcity::town
