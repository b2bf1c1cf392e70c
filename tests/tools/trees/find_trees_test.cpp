#include "tools/trees/find_trees.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/tools/trees/flat_place.h"

namespace nightcity::trees {
namespace {

// A house at the origin.
const place::InsideBuilding house = [](const glm::dvec2& p) { return glm::length(p) < 10; };

TreeSet find(const osm::OsmData& map, const ground_cover::Cover& cover = {}) {
  return find_trees(map, cover, bounds, as_metres, ground, house);
}

TEST(FindTrees, TagsSayHowLargeATreeIs) {
  osm::OsmData map;
  map.trees = {{{20, 0}, {{"height", "12 m"}, {"diameter_crown", "7"}}},
               {{40, 0}, {{"height", "20"}}},
               {{60, 0}, {{"diameter_crown", "3"}}},
               {{80, 0}, {{"leaf_type", "needleleaved"}}},
               {{100, 0}, {{"height", "-3"}, {"diameter_crown", "1e9"}}}};
  const TreeSet set = find(map);
  ASSERT_EQ(set.trees.size(), 5u);
  EXPECT_EQ(set.trees[0].height_m, 12);
  EXPECT_EQ(set.trees[0].crown_m, 7);
  EXPECT_EQ(set.trees[1].crown_m, 12);
  EXPECT_EQ(set.trees[2].height_m, 5);
  EXPECT_TRUE(set.trees[3].evergreen);
  EXPECT_EQ(set.assumed_sizes, 2u);
  for (const Tree& tree : set.trees) {
    EXPECT_EQ(tree.foot.z, 5);
    EXPECT_GT(tree.clear_m, 0);
    EXPECT_LT(tree.clear_m, tree.height_m);
  }
}

TEST(FindTrees, TreesInBuildingsAndBeyondTheGroundAreCounted) {
  osm::OsmData map;
  map.trees = {{{1, 1}, {}}, {{600, 0}, {}}, {{std::nan(""), 0}, {}}, {{50, 50}, {}}};
  const TreeSet set = find(map);
  EXPECT_EQ(set.trees.size(), 1u);
  EXPECT_EQ(set.left_out.at("tree in a building or below a bridge"), 1u);
  EXPECT_EQ(set.left_out.at("tree beyond the ground"), 1u);
}

TEST(FindTrees, ARowIsPlantedBetweenTheTreesThatAreMapped) {
  osm::OsmData map;
  map.tree_rows = {{1, {{100, 0}, {140, 0}, {140, 40}}, {}}};
  EXPECT_EQ(find(map).sources.at("in rows"), 10u);  // 80 m, one every 8 m
  map.trees = {{{104, 0}, {}}};                     // the first of them
  EXPECT_EQ(find(map).sources.at("in rows"), 9u);
}

TEST(FindTrees, WoodsHaveATreeInEachSquareWhereNothingElseLies) {
  ground_cover::Cover cover;
  using ground_cover::GroundKind;
  cover.add({1,
             {GroundKind::woodland, false, false},
             {{{100, 100}, {310, 100}, {310, 310}, {100, 310}}}});
  cover.add(
      {2, {GroundKind::water, false, false}, {{{100, 100}, {205, 100}, {205, 310}, {100, 310}}}});
  cover.finish();
  const TreeSet set = find({}, cover);
  // Squares of 7 m, less those whose tree would stand within 4 m of another.
  const double squares = 105.0 * 210 / (wood_spacing_m * wood_spacing_m);
  EXPECT_GT(static_cast<double>(set.trees.size()), 0.7 * squares);
  EXPECT_LE(static_cast<double>(set.trees.size()), 1.1 * squares);
  for (const Tree& tree : set.trees) EXPECT_GE(tree.foot.x, 205);
}

TEST(FindTrees, AHostileMapEndsWithACount) {
  osm::OsmData map;
  map.tree_rows = {{1, {{-1e9, 20}, {1e9, 20}}, {}}};
  ground_cover::Cover cover;
  cover.add({1,
             {ground_cover::GroundKind::woodland, false, false},
             {{{-9e7, -9e7}, {9e7, -9e7}, {0, 9e7}}}});
  cover.finish();
  EXPECT_LE(find(map, cover).trees.size(), max_trees);
}

}  // namespace
}  // namespace nightcity::trees
