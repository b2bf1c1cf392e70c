#include "tools/trees/model_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/tools/trees/flat_place.h"
#include "tools/city/plant_attributes.h"
#include "tools/trees/find_trees.h"

namespace nightcity::trees {
namespace {

city::CityObject make_plant(const glm::dvec3& low, const glm::dvec3& high) {
  city::CityObject object;
  object.type = city::ObjectType::vegetation;
  object.class_name = "SolitaryVegetationObject";
  object.plant.emplace();
  object.polygons.emplace_back().exterior = {low, {high.x, low.y, high.z}, high};
  return object;
}

city::CityObject make_plant_at(const glm::dvec3& place) {
  city::CityObject object = make_plant({}, {});
  object.polygons.clear();
  object.points = {place};
  return object;
}

// A block of plants: its top, its bottom and one side.
city::CityObject make_cover(const glm::dvec3& low, const glm::dvec3& high) {
  city::CityObject object = make_plant(low, high);
  object.class_name = "PlantCover";
  object.polygons[0].exterior = {
      {low.x, low.y, high.z}, {high.x, low.y, high.z}, high, {low.x, high.y, high.z}};
  object.polygons.emplace_back().exterior = {
      low, {low.x, high.y, low.z}, {high.x, high.y, low.z}, {high.x, low.y, low.z}};
  object.polygons.emplace_back().exterior = {
      low, {high.x, low.y, low.z}, {high.x, low.y, high.z}, {low.x, low.y, high.z}};
  return object;
}

NoTree find_reason(const city::CityObject& object) {
  NoTree why = NoTree::is_one;
  find_model_tree(object, &why);
  return why;
}

TEST(ModelTree, SurfacesGiveThePlaceAndWhatAttributesDoNotSay) {
  city::CityObject object = make_plant({10, 20, 5}, {14, 26, 17});
  const auto alone = find_model_tree(object);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->place, glm::dvec2(12, 23));
  EXPECT_EQ(alone->foot_m, 5);
  EXPECT_EQ(alone->height_m, 12);
  EXPECT_EQ(alone->crown_m, 5);  // the mean of 4 and 6
  object.plant->height_m = 9;
  object.plant->crown_m = 3;
  object.plant->trunk_m = 0.5;
  object.points = {{11, 21, 6}};
  const auto said = find_model_tree(object);
  ASSERT_TRUE(said);
  EXPECT_EQ(said->place, glm::dvec2(11, 21));
  EXPECT_EQ(said->foot_m, 6);
  EXPECT_EQ(said->height_m, 9);
  EXPECT_EQ(said->crown_m, 3);
  EXPECT_EQ(said->trunk_m, 0.5);
}

TEST(ModelTree, AnOutlineOrAPointAloneGivesNoHeight) {
  const auto outline = find_model_tree(make_plant({0, 0, 3}, {6, 6, 3}));
  ASSERT_TRUE(outline);
  EXPECT_FALSE(outline->height_m);
  EXPECT_EQ(outline->crown_m, 6);
  const auto point = find_model_tree(make_plant_at({1, 2, 0}));
  ASSERT_TRUE(point);
  EXPECT_FALSE(point->foot_m) << "a model without heights has all of them at 0";
}

TEST(ModelTree, WhatIsNoTreeHasAReason) {
  city::CityObject cover = make_cover({0, 0, 0}, {5, 5, 2.9});
  EXPECT_EQ(find_reason(cover), NoTree::low);
  EXPECT_EQ(find_reason(make_cover({0, 0, 0}, {5, 5, 0})), NoTree::low) << "no height is known";
  EXPECT_EQ(find_reason(make_cover({0, 0, 0}, {5000, 5, 9})), NoTree::wide);
  cover.class_name = "LandUse";
  EXPECT_EQ(find_reason(cover), NoTree::no_plant);
  EXPECT_EQ(find_reason(make_plant({0, 0, 0}, {1, 1, 0.9})), NoTree::low);
  EXPECT_EQ(find_reason(make_plant({0, 0, 0}, {1000, 1000, 9})), NoTree::wide);
  EXPECT_EQ(find_reason(make_plant({0, 0, 0}, {5, 5, 1000})), NoTree::wide);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(find_reason(make_plant({nan, 0, 0}, {nan, 5, 5})), NoTree::nowhere);
  city::CityObject grass = make_plant({0, 0, 0}, {5, 5, 5});
  grass.building_class = "1040";
  EXPECT_EQ(find_reason(grass), NoTree::low);
  city::CityObject nowhere = make_plant_at({});
  nowhere.points.clear();
  EXPECT_EQ(find_reason(nowhere), NoTree::nowhere);
}

TEST(ModelTree, AHighCoverOfPlantsIsAWoodOfItsHeight) {
  city::CityObject cover = make_cover({0, 0, 5}, {70, 70, 12});
  cover.id = "wood";
  cover.polygons[0].interiors = {
      {{0, 0, 12}, {0, 35, 12}, {70, 35, 12}, {70, 0, 12}}};  // half of it
  const auto wood = find_model_tree(cover);
  ASSERT_TRUE(wood);
  EXPECT_EQ(wood->height_m, 7);
  EXPECT_EQ(wood->outlines.size(), 2u) << "its top and the hole";
  const TreeSet set = find_trees({}, {}, bounds, as_metres, ground, {}, {&*wood, 1});
  const double expected = 70 * 35 / (wood_spacing_m * wood_spacing_m);
  const auto number = static_cast<double>(set.trees.size());
  EXPECT_GT(number, 0.6 * expected) << "but for those within 4 m of another";
  EXPECT_LE(number, expected + 10);
  for (const Tree& tree : set.trees) {
    EXPECT_GE(tree.foot.y, 35);
    EXPECT_LE(tree.foot.y, 70);
    EXPECT_EQ(tree.foot.z, 5);
    EXPECT_NEAR(tree.height_m, 7, 1.4);
    EXPECT_EQ(tree.of_model, 0u);
  }
  cover.plant->height_m = 20;
  EXPECT_EQ(find_model_tree(cover)->height_m, 20) << "its attribute goes before its surfaces";
}

TEST(ModelTree, SpeciesAndClassSayWhetherItIsGreenInWinter) {
  const auto is_evergreen = [](const char* species, const char* plant_class) {
    city::CityObject object = make_plant({0, 0, 0}, {5, 5, 5});
    object.plant->species = species;
    object.building_class = plant_class;
    return find_model_tree(object)->habit.evergreen;
  };
  EXPECT_TRUE(is_evergreen("Pinus sylvestris", "1070")) << "the species knows better";
  EXPECT_FALSE(is_evergreen("Larix decidua", "1060"));
  EXPECT_FALSE(is_evergreen("Tilia cordata", ""));
  EXPECT_TRUE(is_evergreen("", "1060"));
  EXPECT_FALSE(is_evergreen("", "1070"));
  EXPECT_TRUE(is_evergreen("", "Coniferous tree"));
}

TEST(PlantAttributes, LengthsAreConvertedAndThoseOfNoPlantAreCounted) {
  city::Plant plant;
  city::set_plant_attribute(plant, "height", "10", "ft");
  EXPECT_DOUBLE_EQ(plant.height_m.value(), 3.048);
  city::set_plant_attribute(plant, "crowndiameter", " 250 ", "urn:ogc:def:uom:UCUM::cm");
  EXPECT_DOUBLE_EQ(plant.crown_m.value(), 2.5);
  city::set_plant_attribute(plant, "trunkdiameter", "0.4", "#m");
  EXPECT_EQ(plant.trunk_m, 0.4);
  EXPECT_EQ(plant.odd_sizes, 0);
  int odd = 0;
  for (const char* value : {"-3", "0", "NaN", "1e9", "inf", "tall", "131"}) {
    city::set_plant_attribute(plant, "height", value);
    EXPECT_EQ(plant.odd_sizes, ++odd) << value;
  }
  city::set_plant_attribute(plant, "height", "5", "furlong");
  EXPECT_EQ(plant.odd_sizes, ++odd);
  for (const char* value : {"-9999", "9999", ""}) city::set_plant_attribute(plant, "height", value);
  EXPECT_EQ(plant.odd_sizes, odd);
  EXPECT_DOUBLE_EQ(plant.height_m.value(), 3.048);
}

ModelTree tree_at(double east, std::optional<double> foot_m) {
  ModelTree tree;
  tree.place = {east, 0};
  tree.foot_m = foot_m;
  return tree;
}

TEST(FindTrees, ATreeOfTheMapThatTheModelHasIsLeftOut) {
  osm::OsmData map;
  map.trees = {{{3.9, 0}, {}}, {{4.1, 0}, {}}};
  const ModelTree model[] = {tree_at(0, 5)};
  const TreeSet set = find_trees(map, {}, bounds, as_metres, ground, {}, model);
  EXPECT_EQ(set.sources.at("of the model"), 1u);
  EXPECT_EQ(set.sources.at("mapped"), 1u);
  EXPECT_EQ(set.left_out.at("tree of the map that the model has"), 1u);
}

TEST(FindTrees, ATreeOfTheModelStandsOnTheGroundOrWhereTheModelSays) {
  const ModelTree model[] = {tree_at(0, 7), tree_at(50, 30), tree_at(100, {}), tree_at(600, 8),
                             tree_at(700, {})};
  const place::InsideBuilding everywhere = [](const glm::dvec2&) { return true; };
  const TreeSet set = find_trees({}, {}, bounds, as_metres, ground, everywhere, model);
  ASSERT_EQ(set.trees.size(), 4u);
  EXPECT_EQ(set.trees[0].foot.z, 5) << "on the ground, 2 m below";
  EXPECT_EQ(set.trees[1].foot.z, 30) << "on a roof";
  EXPECT_EQ(set.trees[2].foot.z, 5) << "a model without heights";
  EXPECT_EQ(set.trees[3].foot.z, 8) << "beyond the ground";
  EXPECT_EQ(set.left_out.at("tree beyond the ground"), 1u);
}

TEST(FindTrees, ASizeOfTheModelIsKeptAndTheRestIsAssumed) {
  ModelTree tree = tree_at(0, 5);
  tree.height_m = 20;
  tree.trunk_m = 1.1;
  tree.odd_sizes = 2;
  ModelTree shrub = tree_at(50, 5);
  shrub.crown_m = 3;
  shrub.is_shrub = true;
  const ModelTree model[] = {tree, shrub, tree_at(90, 5)};
  const TreeSet set = find_trees({}, {}, bounds, as_metres, ground, {}, model);
  ASSERT_EQ(set.trees.size(), 3u);
  EXPECT_EQ(set.trees[0].height_m, 20);
  EXPECT_EQ(set.trees[0].crown_m, 12);
  EXPECT_EQ(set.trees[0].trunk_m, 1.1);
  EXPECT_EQ(set.trees[1].crown_m, 3);
  EXPECT_EQ(set.trees[1].clear_m, 0) << "leaves down to the ground";
  EXPECT_EQ(set.assumed_sizes, 1u);
  EXPECT_EQ(set.odd_sizes, 2u);
}

TEST(FindTrees, TheGenusOfAMappedTreeSaysWhatItsLeavesAre) {
  osm::OsmData map;
  map.trees = {{{0, 0}, {{"species", "Picea abies"}}},
               {{20, 0}, {{"genus", "Larix"}, {"leaf_type", "needleleaved"}}},
               {{40, 0}, {{"genus", "Pinus"}, {"leaf_cycle", "deciduous"}}},
               {{60, 0}, {{"genus", "Acer"}}}};
  const TreeSet set = find_trees(map, {}, bounds, as_metres, ground, {});
  ASSERT_EQ(set.trees.size(), 4u);
  EXPECT_TRUE(set.trees[0].evergreen);
  EXPECT_FALSE(set.trees[1].evergreen);
  EXPECT_FALSE(set.trees[2].evergreen) << "a tag comes first";
  EXPECT_FALSE(set.trees[3].evergreen);
}

}  // namespace
}  // namespace nightcity::trees
