#include "tools/trees/find_trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/tools/trees/flat_place.h"
#include "tools/ground_cover/land_areas.h"

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

TEST(FindTrees, TagsInEveryLanguageAndAgeSayWhatStaysGreen) {
  const auto is_green = [](const osm::OsmTags& tags) {
    osm::OsmData map;
    map.trees = {{{20, 0}, tags}};
    return find(map).trees.at(0).evergreen;
  };
  for (const osm::OsmTags& tags : {osm::OsmTags{{"taxon", "Picea abies"}},
                                   {{"taxon:species", "Pinus nigra"}},
                                   {{"species:de", "Gemeine Fichte"}},
                                   {{"genus:de", "Waldkiefer"}},
                                   {{"species:en", "Norway Spruce"}},
                                   {{"wood", "coniferous"}},
                                   {{"type", "conifer"}},
                                   {{"type", "palm"}},
                                   {{"leaf_cycle", "semi_evergreen"}},
                                   {{"species", "Ilex aquifolium"}},
                                   {{"species", "Quercus ilex"}},
                                   {{"species", "Quercus ilex"}, {"leaf_type", "broadleaved"}},
                                   {{"genus", "Phoenix"}}})
    EXPECT_TRUE(is_green(tags)) << tags.begin()->first << "=" << tags.begin()->second;
  for (const osm::OsmTags& tags : {osm::OsmTags{{"genus:de", "L\xc3\xa4rche"}},
                                   {{"species:en", "European larch"}},
                                   {{"species", "Ilex verticillata"}},
                                   {{"species:en", "Pineapple guava"}},
                                   {{"species", "Quercus robur"}, {"species:de", "Eiche"}},
                                   {{"wood", "deciduous"}},
                                   {{"leaf_type", "broadleaved"}, {"genus", "Pinus"}},
                                   {{"leaf_cycle", "semi_deciduous"}, {"genus", "Pinus"}}})
    EXPECT_FALSE(is_green(tags)) << tags.begin()->first << "=" << tags.begin()->second;
}

TEST(FindTrees, AnEstimatedHeightIsBetterThanNone) {
  osm::OsmData map;
  map.trees = {{{20, 0}, {{"est_height", "18"}}},
               {{40, 0}, {{"height", "9"}, {"est_height", "1"}}}};
  const TreeSet set = find(map);
  EXPECT_EQ(set.trees.at(0).height_m, 18);
  EXPECT_EQ(set.trees.at(1).height_m, 9);
}

TEST(FindTrees, TreesOfAWoodAreAsItsTagsSay) {
  const auto grow = [](osm::OsmTags tags) {
    ground_cover::Cover cover;
    tags.emplace("natural", "wood");
    const std::vector<osm::MapArea> woods{
        {"way/1", tags, {{{{-200, -200}, {200, -200}, {200, 200}, {-200, 200}}, {}}}}};
    ground_cover::add_land(woods, as_metres, bounds, cover);
    cover.finish();
    return find({}, cover).trees;
  };
  const auto count_green = [](const std::vector<Tree>& trees) {
    return std::count_if(trees.begin(), trees.end(), [](const Tree& t) { return t.evergreen; });
  };
  const auto plain = grow({});
  ASSERT_GT(plain.size(), 1000u);
  EXPECT_EQ(count_green(plain), 0);
  const auto spruces = grow({{"leaf_type", "needleleaved"}, {"height", "25 m"}});
  EXPECT_EQ(count_green(spruces), std::ssize(spruces));
  double sum_m = 0;
  for (const Tree& tree : spruces) sum_m += tree.height_m;
  EXPECT_NEAR(sum_m / static_cast<double>(spruces.size()), 25, 0.5);
  const auto mixed = grow({{"leaf_type", "mixed"}});
  EXPECT_NEAR(static_cast<double>(count_green(mixed)) / static_cast<double>(mixed.size()), 0.5,
              0.05);
}

}  // namespace
}  // namespace nightcity::trees
