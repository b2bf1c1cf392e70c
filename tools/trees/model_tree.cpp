#include "tools/trees/model_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "formats/finite.h"
#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/plant_attributes.h"
#include "tools/ring_area.h"

namespace nightcity::trees {
namespace {

constexpr double flat_m = 0.01;  // a crown's outline has no height to go by

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
  bool empty() const { return !(low.x <= high.x); }
  glm::dvec3 size() const { return high - low; }
};

Box find_box(const city::CityObject& object) {
  Box box;
  for (const city::Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior) {
      if (!finite(p)) continue;
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  return box;
}

// Codes of the list SolitaryVegetationObject_class of SIG3D (CityGML 2.0, annex C), which PLATEAU
// uses too.
enum class PlantClass : std::uint8_t { unknown, low, shrub, coniferous, deciduous };
PlantClass find_class(const std::string& text) {
  const auto code = city::parse_number(text);
  if (code == 1000 || code == 1080) return PlantClass::shrub;
  if (code == 1010 || code == 1040 || code == 1050 || code == 1090 || code == 1100)
    return PlantClass::low;  // low plants, grasses, ferns, aquatic plants, climbers
  if (code == 1060) return PlantClass::coniferous;
  if (code == 1070) return PlantClass::deciduous;
  if (code) return PlantClass::unknown;
  const std::string words = to_lower(text);
  const auto says = [&](const char* word) { return words.find(word) != std::string::npos; };
  if (says("shrub") || says("bush") || says("hedge")) return PlantClass::shrub;
  if (says("grass") || says("fern") || says("climber")) return PlantClass::low;
  return PlantClass::unknown;
}

LeafHabit find_habit(const city::CityObject& object, PlantClass plant_class) {
  if (const auto habit = find_leaf_habit(object.plant->species)) return *habit;
  if (const auto habit = find_leaf_habit(object.building_class)) return *habit;
  const bool coniferous = plant_class == PlantClass::coniferous;
  return {coniferous, coniferous};
}

// A model without heights has all of them at 0 exactly.
std::optional<double> known_height(double z) {
  return z == 0 ? std::nullopt : std::optional(z);
}

NoTree judge(const city::CityObject& object, const Box& box, ModelTree& tree) {
  const city::Plant& plant = *object.plant;
  const PlantClass plant_class = find_class(object.building_class);
  if (plant_class == PlantClass::low) return NoTree::low;
  tree.height_m = plant.height_m;
  tree.crown_m = plant.crown_m;
  tree.trunk_m = plant.trunk_m;
  if (!box.empty()) {
    const glm::dvec3 size = box.size();
    const double width = (size.x + size.y) / 2;
    if (!(width <= city::max_crown_m && size.z <= city::max_plant_height_m)) return NoTree::wide;
    if (!tree.height_m && size.z > flat_m) tree.height_m = size.z;
    if (!tree.crown_m && width > flat_m) tree.crown_m = width;
    tree.place = (glm::dvec2(box.low) + glm::dvec2(box.high)) / 2.0;
    tree.foot_m = known_height(box.low.z);
  }
  if (tree.height_m && *tree.height_m < min_tree_m) return NoTree::low;
  tree.habit = find_habit(object, plant_class);
  tree.is_shrub = plant_class == PlantClass::shrub;
  tree.odd_sizes = plant.odd_sizes;
  return NoTree::is_one;
}

std::vector<glm::dvec2> to_plan(const city::Ring& ring) {
  std::vector<glm::dvec2> plan;
  for (const glm::dvec3& p : ring)
    if (finite(p)) plan.emplace_back(p);
  return plan;
}

// Returns the plan of a cover's surfaces that face upward; of those that face downward where there
// are no others, as in a file that winds them the wrong way.
std::vector<std::vector<glm::dvec2>> find_outlines(const city::CityObject& object) {
  constexpr double min_area_m2 = 0.05;  // what stands upright has none
  std::array<std::vector<std::vector<glm::dvec2>>, 2> found;
  for (const city::Polygon& polygon : object.polygons) {
    std::vector<glm::dvec2> exterior = to_plan(polygon.exterior);
    const double area = signed_area(exterior);
    if (!(std::abs(area) > min_area_m2)) continue;
    auto& rings = found[area > 0 ? 0 : 1];
    rings.push_back(std::move(exterior));
    for (const city::Ring& hole : polygon.interiors)
      if (std::vector<glm::dvec2> ring = to_plan(hole); ring.size() > 2)
        rings.push_back(std::move(ring));
  }
  return std::move(found[found[0].empty() ? 1 : 0]);
}

NoTree judge_cover(const city::CityObject& object, const Box& box, ModelTree& tree) {
  if (box.empty()) return NoTree::nowhere;
  const glm::dvec3 size = box.size();
  tree.height_m = object.plant->height_m;
  if (!tree.height_m && size.z > flat_m && size.z <= city::max_plant_height_m)
    tree.height_m = size.z;
  if (!tree.height_m || *tree.height_m < min_wood_m) return NoTree::low;
  tree.outlines = find_outlines(object);
  std::size_t corners = 0;
  for (const auto& ring : tree.outlines) corners += ring.size();
  if (corners == 0) return NoTree::nowhere;
  if (!(std::max(size.x, size.y) <= max_wood_width_m) || corners > max_wood_corners)
    return NoTree::wide;
  tree.place = (glm::dvec2(box.low) + glm::dvec2(box.high)) / 2.0;
  tree.foot_m = known_height(box.low.z);
  tree.habit = find_habit(object, find_class(object.building_class));
  tree.odd_sizes = object.plant->odd_sizes;
  return NoTree::is_one;
}

void name_after(const city::CityObject& object, ModelTree& tree) {
  tree.id = object.id;
  tree.class_name = object.class_name;
  tree.function = object.function.empty() ? object.usage : object.function;
}

}  // namespace

std::optional<ModelTree> find_model_tree(const city::CityObject& object, NoTree* why) {
  const auto refuse = [&](NoTree reason) {
    if (why) *why = reason;
    return std::nullopt;
  };
  const bool is_cover = object.class_name.ends_with("PlantCover");
  if (!object.plant || !(is_cover || object.class_name.ends_with("SolitaryVegetationObject")))
    return refuse(NoTree::no_plant);
  const Box box = find_box(object);
  if (is_cover) {
    ModelTree wood;
    name_after(object, wood);
    if (const NoTree reason = judge_cover(object, box, wood); reason != NoTree::is_one)
      return refuse(reason);
    return wood;
  }
  if (box.empty() && object.points.empty()) return refuse(NoTree::nowhere);
  ModelTree tree;
  if (const NoTree reason = judge(object, box, tree); reason != NoTree::is_one)
    return refuse(reason);
  if (!object.points.empty()) {
    tree.place = glm::dvec2(object.points.front());
    tree.foot_m = known_height(object.points.front().z);
  }
  name_after(object, tree);
  return tree;
}

}  // namespace nightcity::trees
