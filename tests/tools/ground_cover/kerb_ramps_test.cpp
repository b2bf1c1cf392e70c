#include "tools/ground_cover/kerb_ramps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/ground_cover/cover.h"
#include "tools/ground_cover/painter.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/roads/carriageway.h"
#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {
namespace {

const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
constexpr Box bounds{{-500, -500}, {500, 500}};
const osm::OsmTags crossing{{"highway", "crossing"}};

// A street along the x axis with a node at the origin, and what else is given.
Cover make_cover(const osm::OsmTags& node, std::vector<osm::OsmWay> more = {},
                 const char* highway = "residential") {
  std::vector<osm::OsmWay> ways{{1, {{-100, 0}, {0, 0}, {100, 0}}, {{"highway", highway}}}};
  ways.insert(ways.end(), more.begin(), more.end());
  std::vector<osm::OsmPoint> nodes;
  if (!node.empty()) nodes.push_back({{0, 0}, node});
  Cover cover;
  add_streets(ways, false, as_metres, bounds, cover);
  add_kerb_ramps(ways, nodes, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

double find_half_width() {
  return roads::read_carriageway({{"highway", "residential"}})->width_m / 2;
}

TEST(KerbRamps, TheKerbOfACrossingIsThreeCentimetresHighAndTheRampRisesBySixPerCent) {
  const Cover cover = make_cover(crossing);
  EXPECT_EQ(cover.lowered_kerbs, 1u);
  const double edge_m = find_half_width();
  constexpr double hair = 1e-6;
  for (const double side : {-1.0, 1.0}) {
    const auto depth = [&](double along, double beyond_m) {
      return cover.depth_at({along, side * (edge_m + beyond_m)});
    };
    EXPECT_NEAR(depth(0, -hair), roads::kerb_m, 1e-9) << "the carriageway stays";
    EXPECT_NEAR(roads::kerb_m - depth(0, hair), 0.03, 1e-6);
    EXPECT_NEAR(roads::kerb_m - depth(1.99, hair), 0.03, 1e-6);
    EXPECT_NEAR(depth(0, 1), 0.09 - max_ramp_slope, 1e-6);
    EXPECT_EQ(depth(0, 1.51), 0);
    EXPECT_NEAR(depth(crossing_m / 2 + flare_m / 2, hair), 0.045, 1e-6) << "half-way down";
    EXPECT_EQ(depth(crossing_m / 2 + flare_m + 0.01, hair), 0);
  }
}

TEST(KerbRamps, TheFacetsOfARampMeetWithoutSteps) {
  const std::vector<RampFacet> facets = make_ramp({3, 4}, {0.6, 0.8}, {-0.8, 0.6}, 0.09);
  for (const RampFacet& one : facets)
    for (const RampFacet& other : facets)
      for (const glm::dvec2& corner : one.ring)
        for (const glm::dvec2& same : other.ring)
          if (glm::distance(corner, same) < 1e-12) {
            EXPECT_NEAR(one.find_lowering_m(corner), other.find_lowering_m(corner), 1e-12);
          }
}

TEST(KerbRamps, TheTagKerbSaysHowHighItIs) {
  const glm::dvec2 beside(0, find_half_width() + 1e-6);
  const auto depth = [&](const char* kerb) {
    return make_cover({{"highway", "crossing"}, {"kerb", kerb}}).depth_at(beside);
  };
  EXPECT_NEAR(depth("lowered"), 0.09, 1e-6);
  EXPECT_NEAR(depth("flush"), roads::kerb_m, 1e-6);
  EXPECT_NEAR(depth("no"), roads::kerb_m, 1e-6);
  EXPECT_EQ(depth("raised"), 0);
  EXPECT_NEAR(depth("nonsense"), 0.09, 1e-6);
}

TEST(KerbRamps, TheWayOfACrossingIsOneAsWell) {
  const osm::OsmWay path{
      2, {{0, -9}, {0, 0}, {0, 9}}, {{"highway", "footway"}, {"footway", "crossing"}}};
  EXPECT_EQ(make_cover({}, {path}).lowered_kerbs, 1u);
  EXPECT_EQ(make_cover(crossing, {path}).lowered_kerbs, 1u) << "once";
  osm::OsmWay pavement = path;
  pavement.tags["footway"] = "sidewalk";
  EXPECT_EQ(make_cover({}, {pavement}).lowered_kerbs, 0u);
}

TEST(KerbRamps, JunctionsAndStreetsWithoutKerbsHaveNone) {
  const osm::OsmWay side{2, {{0, 0}, {0, 90}}, {{"highway", "residential"}}};
  EXPECT_EQ(make_cover(crossing, {side}).lowered_kerbs, 0u);
  EXPECT_EQ(make_cover(crossing, {}, "track").lowered_kerbs, 0u);
  EXPECT_EQ(make_cover(crossing, {}, "footway").lowered_kerbs, 0u);
}

TEST(KerbRamps, TunnelsAndBridgesHaveNone) {
  for (const char* key : {"tunnel", "bridge"}) {
    const osm::OsmWay way{1, {{-9, 0}, {0, 0}, {9, 0}}, {{"highway", "residential"}, {key, "yes"}}};
    Cover cover;
    add_kerb_ramps(std::vector{way}, std::vector<osm::OsmPoint>{{{0, 0}, crossing}}, as_metres,
                   bounds, cover);
    EXPECT_EQ(cover.lowered_kerbs, 0u) << key;
  }
}

TEST(KerbRamps, HostileNodesHaveNone) {
  const osm::OsmWay way{
      1, {{0, 0}, {0, 0}, {std::nan(""), 9}, {1e300, 0}}, {{"highway", "residential"}}};
  std::vector<osm::OsmPoint> nodes{
      {{0, 0}, crossing}, {{std::nan(""), 9}, crossing}, {{1e300, 0}, crossing}};
  Cover cover;
  add_kerb_ramps(std::vector{way}, nodes, as_metres, bounds, cover);
  cover.finish();
  for (const RampFacet& facet : cover.ramps())
    for (const glm::dvec2& corner : facet.ring) EXPECT_TRUE(std::isfinite(corner.x + corner.y));
}

}  // namespace
}  // namespace nightcity::ground_cover
