#include "tools/bridges/bridge_way.h"

#include <gtest/gtest.h>

namespace nightcity::bridges {
namespace {

TEST(BridgeWay, TagsSayWhetherAWayLeavesTheGround) {
  EXPECT_TRUE(is_bridge({{"bridge", "yes"}}));
  EXPECT_TRUE(is_bridge({{"bridge", "viaduct"}}));
  EXPECT_FALSE(is_bridge({{"bridge", "no"}}));
  EXPECT_FALSE(is_bridge({{"bridge", "boardwalk"}}));
  EXPECT_FALSE(is_bridge({{"layer", "1"}}));
}

TEST(BridgeWay, LayersThatMakeNoSenseAreTheUsualOnes) {
  EXPECT_EQ(read_layer({}), 0);
  EXPECT_EQ(read_layer({{"bridge", "yes"}}), 1);
  EXPECT_EQ(read_layer({{"bridge", "yes"}, {"layer", "2"}}), 2);
  EXPECT_EQ(read_layer({{"bridge", "yes"}, {"layer", "1e9"}}), 1);
  EXPECT_EQ(read_layer({{"layer", "nan"}}), 0);
  EXPECT_EQ(read_layer({{"layer", "-1"}}), -1);
}

TEST(BridgeWay, TunnelsAndWhatIsNoRoadCarryNothing) {
  EXPECT_EQ(find_carried({{"highway", "primary"}}), Carried::street);
  EXPECT_EQ(find_carried({{"highway", "footway"}}), Carried::path);
  EXPECT_EQ(find_carried({{"railway", "tram"}}), Carried::rail);
  EXPECT_FALSE(find_carried({{"highway", "primary"}, {"tunnel", "yes"}}));
  EXPECT_FALSE(find_carried({{"railway", "subway"}, {"layer", "-1"}}));
  EXPECT_FALSE(find_carried({{"railway", "platform"}}));
  EXPECT_FALSE(find_carried({{"highway", "proposed"}}));
}

TEST(BridgeWay, DecksAreWiderThanWhatTheyCarry) {
  // A carriageway of 6 m: a pavement of 2.50 m and a ledge of 0.25 m, or a cap of 2.05 m.
  const osm::OsmTags walked{{"highway", "residential"}, {"width", "6"}, {"sidewalk", "both"}},
      bare{{"highway", "motorway"}, {"width", "6"}, {"sidewalk", "no"}};
  EXPECT_NEAR(find_half_width_m(walked, Carried::street), 3 + 2.5 + 0.25, 1e-9);
  EXPECT_NEAR(find_half_width_m(bare, Carried::street), 3 + 2.05, 1e-9);
  EXPECT_NEAR(find_half_width_m({{"highway", "footway"}, {"width", "3"}}, Carried::path), 1.75,
              1e-9);
  // Two tracks 4 m apart on beds of 4.90 m.
  EXPECT_NEAR(find_half_width_m({{"railway", "rail"}, {"tracks", "2"}}, Carried::rail),
              (4.905 + 4) / 2 + 0.25, 1e-2);
}

}  // namespace
}  // namespace nightcity::bridges
