#include "tools/osm/crowded_streets.h"

#include <gtest/gtest.h>

namespace nightcity::osm {
namespace {

OsmWay make_way(std::int64_t id, std::vector<glm::dvec2> lon_lat) {
  return {id, std::move(lon_lat), {}};
}

TEST(CrowdedStreets, ThoseBeyondTheFirstOfAPlaceAreLeftOut) {
  std::vector<OsmWay> star;
  for (std::int64_t i = 0; i < 100; ++i)
    star.push_back(make_way(i, {{13, 52}, {13.001, 52 + 1e-5 * static_cast<double>(i)}}));
  star.push_back(make_way(100, {{14, 52}, {14, 53}}));
  EXPECT_EQ(leave_out_crowded(star), 100 - max_streets_at_node);
  ASSERT_EQ(star.size(), max_streets_at_node + 1);
  EXPECT_EQ(star[max_streets_at_node - 1].id, std::int64_t{max_streets_at_node} - 1);
  EXPECT_EQ(star.back().id, 100) << "nothing else meets it";
}

TEST(CrowdedStreets, AStreetCountsAsOftenAsItReturns) {
  std::vector<glm::dvec2> back_and_forth;
  for (std::size_t i = 0; i <= max_streets_at_node; ++i) {
    back_and_forth.emplace_back(13, 52);
    back_and_forth.emplace_back(13.1, 52);
  }
  std::vector<OsmWay> ways{make_way(1, back_and_forth), make_way(2, {{13, 52}, {12, 52}})};
  EXPECT_EQ(leave_out_crowded(ways), 1u);
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0].id, 2) << "what is left out takes no place";
}

TEST(CrowdedStreets, PlacesOfTheWholeGlobeAreTold) {
  std::vector<OsmWay> ways;
  for (std::int64_t i = 0; i < 60; ++i)
    for (const double lon : {-180.0, 0.0, 180.0})
      for (const double lat : {-90.0, 0.0, 90.0}) ways.push_back(make_way(i, {{lon, lat}}));
  EXPECT_EQ(leave_out_crowded(ways), 0u);
}

}  // namespace
}  // namespace nightcity::osm
