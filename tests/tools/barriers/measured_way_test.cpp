#include "tools/barriers/measured_way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace nightcity::barriers {
namespace {

MeasuredWay make_way() {
  return {{{0, 0}, {10, 0}, {10, 20}}, {0, 10, 30}, {{4, 6}, {9, 12}}};
}

TEST(MeasuredWay, ItIsOpenWithinItsOpeningsAlone) {
  const MeasuredWay way = make_way();
  for (double s = 0.05; s < 30; s += 0.1)
    EXPECT_EQ(way.is_open_at(s), (s > 4 && s < 6) || (s > 9 && s < 12)) << s;
}

TEST(MeasuredWay, CutsAreInOrderAndHaveTheEdgesOfOpenings) {
  const auto first = make_way().find_cuts(0, 0, 10, 3), second = make_way().find_cuts(1, 0, 20, 50);
  EXPECT_EQ(first, (std::vector<double>{0, 2.5, 4, 5, 6, 7.5, 9, 10}));
  EXPECT_EQ(second, (std::vector<double>{0, 2, 20}));
}

TEST(MeasuredWay, OpeningsThatOverlapAreOne) {
  osm::OsmData map;
  map.barriers = {{1, {{0, 0}, {1, 0}, {50, 0}}, {{"barrier", "wall"}}}};
  map.gates = {{{0, 0}, {{"barrier", "gate"}, {"width", "3"}}},
               {{1, 0}, {{"barrier", "gate"}, {"width", "1"}}}};
  const MeasuredWay way = measure(
      map.barriers[0], [](const glm::dvec2& p) { return p; }, Openings(map));
  ASSERT_EQ(way.openings_m.size(), 1u);
  EXPECT_EQ(way.openings_m[0], std::pair(-1.5, 1.5));
}

TEST(MeasuredWay, PlacesThatAreNotFiniteAreLeftOut) {
  const osm::OsmWay way{1, {{0, 0}, {1, std::nan("")}, {3, 4}}, {}};
  const MeasuredWay line = measure(
      way, [](const glm::dvec2& p) { return p; }, Openings({}));
  EXPECT_EQ(line.points.size(), 2u);
  EXPECT_EQ(line.length_m(), 5);
  EXPECT_EQ(measure(
                {1, {}, {}}, [](const glm::dvec2& p) { return p; }, Openings({}))
                .length_m(),
            0);
}

}  // namespace
}  // namespace nightcity::barriers
