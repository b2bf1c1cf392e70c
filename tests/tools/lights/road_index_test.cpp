#include "tools/lights/road_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace nightcity::lights {
namespace {

TEST(RoadIndex, AgreesWithBruteForce) {
  std::vector<osm::OsmWay> ways;
  std::uint32_t state = 1;
  const auto random = [&] {
    return (state = state * 1664525u + 1013904223u) / 4294967296.0 * 800 - 400;
  };
  for (int n = 0; n < 60; ++n)
    ways.push_back({n,
                    {{random(), random()}, {random(), random()}, {random(), random()}},
                    {{"highway", "residential"}}});
  const RoadIndex index(ways, [](const glm::dvec2& p) { return p; });
  int found = 0;
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec2 p(random(), random());
    double best = 1e300;
    for (const osm::OsmWay& way : ways)
      for (std::size_t k = 0; k + 1 < way.lon_lat.size(); ++k) {
        const glm::dvec2 a = way.lon_lat[k], edge = way.lon_lat[k + 1] - a;
        const double t = glm::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
        best = std::min(best, glm::distance(p, a + edge * t));
      }
    const auto nearest = index.nearest(p);
    ASSERT_EQ(nearest.has_value(), best <= nearest_road_m);
    if (nearest) {
      EXPECT_NEAR(nearest->distance_m, best, 1e-9);
      ++found;
    }
  }
  EXPECT_GT(found, 500);
}

TEST(RoadIndex, OfWaysThatShareTheNearestNodeTheOrderAndTheIdsDecideNothing) {
  // Both ways lead away from the lamp, and are as wide.
  std::vector<osm::OsmWay> ways{
      {1, {{0, 0}, {-80, 60}}, {{"highway", "residential"}, {"width", "6"}}},
      {2, {{0, 0}, {-80, -60}}, {{"highway", "tertiary"}, {"width", "6"}}},
      {3, {{0, 0}, {-100, 0}}, {{"highway", "service"}, {"width", "6"}}}};
  for (int round = 0; round < 3; ++round) {
    std::rotate(ways.begin(), ways.begin() + 1, ways.end());
    for (std::size_t n = 0; n < ways.size(); ++n) ways[n].id = static_cast<std::int64_t>(n);
    const RoadIndex index(ways, [](const glm::dvec2& p) { return p; });
    const auto nearest = index.nearest({8, 0});
    ASSERT_TRUE(nearest);
    EXPECT_EQ(std::string(nearest->road->lighting->highway), "tertiary") << round;
  }
}

}  // namespace
}  // namespace nightcity::lights
