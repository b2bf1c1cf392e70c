#include "tools/lights/road_index.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
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

}  // namespace
}  // namespace nightcity::lights
