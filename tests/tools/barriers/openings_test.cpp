#include "tools/barriers/openings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::barriers {
namespace {

constexpr glm::dvec2 node{13.4, 52.5}, other{13.5, 52.5};

osm::OsmData map_of_a_wall() {
  osm::OsmData map;
  map.barriers = {{1, {node, other}, {{"barrier", "wall"}}}};
  return map;
}

TEST(Openings, ABarrierIsClosedWhereNothingMeetsIt) {
  EXPECT_EQ(Openings(map_of_a_wall()).width_at(node), 0);
  EXPECT_EQ(Openings(map_of_a_wall()).width_at({0, 0}), 0);
}

TEST(Openings, TheWidestOfWhatPassesDecides) {
  osm::OsmData map = map_of_a_wall();
  map.highways = {{2, {node, {13.4, 52.6}}, {{"highway", "footway"}}},
                  {3, {node, {13.4, 52.4}}, {{"highway", "service"}, {"width", "4"}}}};
  EXPECT_NEAR(Openings(map).width_at(node), 4.4, 1e-9);  // two lanes of 2.2 m at least
  EXPECT_EQ(Openings(map).width_at(other), 0);
}

TEST(Openings, TheOutlineOfASquareOpensNothing) {
  osm::OsmData map = map_of_a_wall();
  map.highways = {{2, {node, other}, {{"highway", "pedestrian"}, {"area", "yes"}}}};
  EXPECT_EQ(Openings(map).width_at(node), 0);
}

TEST(Openings, AGateElsewhereOpensNothing) {
  osm::OsmData map = map_of_a_wall();
  map.gates = {{{13.4, 52.50001}, {{"barrier", "gate"}}},
               {{std::nan(""), 0}, {{"barrier", "gate"}, {"width", "3"}}}};
  EXPECT_EQ(Openings(map).width_at(node), 0);
}

}  // namespace
}  // namespace nightcity::barriers
