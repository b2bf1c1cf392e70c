#include "tools/streets/street_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tools/layout/street_plane.h"

namespace nightcity::streets {
namespace {

using test::street;

const osm::OsmTags residential = {{"highway", "residential"}};

StreetNetwork network_of(const std::vector<osm::OsmWay>& ways) {
  std::vector<const osm::OsmWay*> pointers;
  for (const osm::OsmWay& way : ways) pointers.push_back(&way);
  return make_street_network(pointers, test::to_plane);
}

double total_length(const StreetNetwork& network) {
  double sum = 0;
  for (const Street& s : network.streets) sum += s.length_m();
  return sum;
}

TEST(StreetNetwork, AWayIsCutWhereAnotherEndsOnIt) {
  const StreetNetwork network = network_of({street(1, {{0, 0}, {100, 0}, {250, 0}}, residential),
                                            street(2, {{100, 0}, {100, 80}}, residential)});
  ASSERT_EQ(network.streets.size(), 3u);
  EXPECT_EQ(network.joints.size(), 4u);
  EXPECT_NEAR(total_length(network), 330, 1e-6);
  const auto junctions = std::count_if(network.joints.begin(), network.joints.end(),
                                       [](const Joint& j) { return j.ends.size() == 3; });
  EXPECT_EQ(junctions, 1);
}

TEST(StreetNetwork, PiecesOfOneStreetAreJoinedWhicheverWayTheyAreDrawn) {
  const StreetNetwork network = network_of({street(1, {{0, 0}, {50, 0}}, residential),
                                            street(2, {{120, 0}, {50, 0}}, residential),
                                            street(3, {{120, 0}, {120, 30}}, residential)});
  ASSERT_EQ(network.streets.size(), 1u);
  EXPECT_NEAR(network.streets[0].length_m(), 150, 1e-6);
  EXPECT_EQ(network.joints.size(), 2u);
  // A lamp 60 m from the start stands on way 2, which is drawn backwards, 60 m before its end.
  const Street& joined = network.streets[0];
  const bool from_west = joined.line.front().x < 1;
  const Street::Place place = joined.place(from_west ? 60 : 90);
  EXPECT_NEAR(place.point.x, 60, 1e-6);
  EXPECT_EQ(place.way_id, 2);
  EXPECT_NEAR(place.on_way_m, 60, 1e-6);
}

TEST(StreetNetwork, AChangeOfClassEndsAStreet) {
  const StreetNetwork network =
      network_of({street(1, {{0, 0}, {50, 0}}, residential),
                  street(2, {{50, 0}, {120, 0}}, {{"highway", "tertiary"}})});
  EXPECT_EQ(network.streets.size(), 2u);
  EXPECT_EQ(network.joints.size(), 3u);
}

TEST(StreetNetwork, ARingWithoutJunctionsIsOneStreet) {
  const StreetNetwork network =
      network_of({street(1, {{0, 0}, {50, 0}, {50, 50}, {0, 50}, {0, 0}}, residential)});
  ASSERT_EQ(network.streets.size(), 1u);
  EXPECT_EQ(network.joints.size(), 1u);
  EXPECT_NEAR(network.streets[0].length_m(), 200, 1e-6);
}

TEST(StreetNetwork, RepeatedNodesAndBrokenPlacesDoNoHarm) {
  const StreetNetwork network =
      network_of({street(1, {{0, 0}, {0, 0}, {40, 0}, {40, 0}}, residential),
                  street(2, {{5, 5}}, residential), street(3, {{7, 7}, {7, 7}}, residential),
                  street(4, {{NAN, 0}, {0, 90}, {0, 120}}, residential)});
  EXPECT_NEAR(total_length(network), 70, 1e-6);
  for (const Street& s : network.streets)
    for (std::size_t n = 1; n < s.at_m.size(); ++n) EXPECT_GT(s.at_m[n], s.at_m[n - 1]);
}

}  // namespace
}  // namespace nightcity::streets
