#include "tools/ground_cover/junctions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::ground_cover {
namespace {

osm::OsmWay road(std::vector<glm::dvec2> line, const char* highway, const char* width) {
  return {1, std::move(line), {{"highway", highway}, {"width", width}}};
}

TEST(Junctions, AreWhereMoreThanTwoArmsMeet) {
  const std::vector<osm::OsmWay> ways{road({{0, 0}, {1, 0}, {2, 0}}, "residential", "6"),
                                      road({{2, 0}, {3, 0}}, "residential", "6"),
                                      road({{1, 0}, {1, 1}}, "residential", "6"),
                                      road({{2, 0}, {2, 1}}, "footway", "2")};
  const Junctions junctions(ways);
  EXPECT_TRUE(junctions.holds({1, 0}));
  EXPECT_FALSE(junctions.holds({0, 0}));
  EXPECT_FALSE(junctions.holds({2, 0})) << "a street that goes on, and a path";
  EXPECT_FALSE(junctions.holds({std::nan(""), 0}));
}

TEST(Junctions, AStreetReachesHalfItsWidthAndKeepsClearOfParkedCars) {
  const std::vector<osm::OsmWay> ways{road({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, "residential", "9"),
                                      road({{1, 0}, {1, 1}}, "residential", "6"),
                                      road({{2, 0}, {2, 1}}, "service", "6")};
  const Junctions junctions(ways);
  EXPECT_EQ(junctions.find_reach_m({1, 0}, ways[0], 5), 3 + 5);
  EXPECT_EQ(junctions.find_reach_m({1, 0}, ways[1], 5), 4.5 + 5);
  EXPECT_EQ(junctions.find_reach_m({2, 0}, ways[0], 5), 3) << "an entrance";
  EXPECT_EQ(junctions.find_reach_m({3, 0}, ways[0], 5), 0);
}

}  // namespace
}  // namespace nightcity::ground_cover
