#include "tools/bridges/chains.h"

#include <gtest/gtest.h>

#include "tests/tools/bridges/bridge_map.h"

namespace nightcity::bridges {
namespace {

std::vector<PlacedWay> place(const std::vector<osm::OsmWay>& ways) {
  std::vector<PlacedWay> placed;
  for (const osm::OsmWay& way : ways)
    placed.push_back(place_way(way, Carried::street, test::to_metres));
  return placed;
}

TEST(Chains, WaysThatMeetEndToEndAreOneWhateverTheirDirections) {
  const std::vector<osm::OsmWay> ways{test::way(1, {{0, 0}, {50, 0}}, test::bridge),
                                      test::way(2, {{90, 0}, {50, 0}}, test::bridge),
                                      test::way(3, {{90, 0}, {99, 0}}, test::bridge)};
  const auto chains = join_chains(place(ways), {});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].line, (std::vector<glm::dvec2>{{0, 0}, {50, 0}, {90, 0}, {99, 0}}));
  EXPECT_TRUE(chains[0].parts[1].reversed);
}

TEST(Chains, GoOnStraightWhereThreeMeet) {
  const std::vector<osm::OsmWay> ways{test::way(1, {{50, 0}, {60, 40}}, test::bridge),
                                      test::way(2, {{0, 0}, {50, 0}}, test::bridge),
                                      test::way(3, {{50, 0}, {99, 0}}, test::bridge)};
  const auto chains = join_chains(place(ways), {});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].line.size(), 2u);
  EXPECT_EQ(chains[1].line, (std::vector<glm::dvec2>{{0, 0}, {50, 0}, {99, 0}}));
}

TEST(Chains, EndWhereAStreetOnTheGroundMeetsThem) {
  const std::vector<osm::OsmWay> ways{test::way(1, {{0, 0}, {50, 0}}, test::bridge),
                                      test::way(2, {{50, 0}, {99, 0}}, test::bridge)};
  const auto placed = place(ways);
  GroundNodes ground;
  ground.of_kind[0].insert(to_key(ways[0].lon_lat.back()));
  EXPECT_EQ(join_chains(placed, ground).size(), 2u);
  ground.of_kind[0].clear();
  ground.of_kind[1].insert(to_key(ways[0].lon_lat.back()));
  EXPECT_EQ(join_chains(placed, ground).size(), 1u) << "a path does not end a street's bridge";
}

TEST(Chains, RingsAreChainsToo) {
  const std::vector<osm::OsmWay> ways{
      test::way(1, {{0, 0}, {50, 0}, {50, 50}, {0, 0}}, test::bridge)};
  const auto chains = join_chains(place(ways), {});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].is_ring());
}

}  // namespace
}  // namespace nightcity::bridges
