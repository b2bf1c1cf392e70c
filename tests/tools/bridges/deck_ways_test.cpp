#include "tools/bridges/deck_ways.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/bridges/bridge_map.h"

namespace nightcity::bridges {
namespace {

TEST(DeckWays, WaysLieOnTheGroundUntilTheDeckLeavesIt) {
  const std::vector<osm::OsmWay> ways = test::street_over_street();
  const BridgeDecks decks = find_decks({ways, {}}, test::to_metres, test::level_ground);
  ASSERT_EQ(decks.decks().size(), 1u);
  const Deck& deck = decks.decks()[0];
  const auto ground = find_ground_ways(ways, decks, test::to_metres);
  ASSERT_EQ(ground.size(), 5u) << "three streets, and both ends of the bridge";
  double longest_m = 0;
  for (const osm::OsmWay& way : ground) {
    EXPECT_FALSE(way.tags.contains("bridge"));
    if (way.id != 2 && way.id != 3) continue;
    for (const glm::dvec2& p : way.lon_lat) {
      const double x = test::to_metres(p).x;
      EXPECT_LE(decks.height_at(1, {x, 0}).value(), 30 + deck_m + 0.2);
      longest_m = std::max(longest_m, 100 - std::abs(x));
    }
  }
  EXPECT_NEAR(longest_m, deck.in_ground_m[0], 1e-6);
  EXPECT_NEAR(deck.in_ground_m[0], deck.in_ground_m[1], 1e-6);
  EXPECT_GT(longest_m, 5);
}

TEST(DeckWays, DecksCarryTheirWaysWithoutTheTagsThatLiftThem) {
  const std::vector<osm::OsmWay> ways = test::street_over_street();
  const BridgeDecks decks = find_decks({ways, {}}, test::to_metres, test::level_ground);
  const auto carried = find_deck_ways(ways, decks, 1);
  ASSERT_EQ(carried.size(), 2u);
  EXPECT_EQ(carried[0].lon_lat, ways[1].lon_lat);
  EXPECT_EQ(carried[0].tags, test::residential);
  EXPECT_TRUE(find_deck_ways(ways, decks, 2).empty());
}

}  // namespace
}  // namespace nightcity::bridges
