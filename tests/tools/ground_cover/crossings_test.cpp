#include "tools/ground_cover/crossings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {
namespace {

osm::OsmWay street(std::vector<glm::dvec2> line) {
  return {1, std::move(line), {{"highway", "tertiary"}, {"lane_markings", "no"}}};
}

osm::OsmPoint node(osm::OsmTags tags) {
  tags.emplace("highway", "crossing");
  return {{0, 0}, std::move(tags)};
}

// The bars of a crossing's node in the middle of a street of 6 m.
Cover paint(const osm::OsmPoint& crossing, std::vector<osm::OsmWay> more = {}) {
  more.push_back(street({{-200, 0}, {0, 0}, {200, 0}}));
  Cover cover;
  add_streets(more, true, as_metres, bounds, cover);
  add_markings({more, {}, std::span(&crossing, 1)}, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

std::size_t count_bars(const Cover& cover) {
  const auto found = cover.markings.find("bar of a crossing");
  return found == cover.markings.end() ? 0 : found->second;
}

TEST(Crossings, ANodeHasBarsAcrossItsStreet) {
  const Cover cover = paint(node({{"crossing", "zebra"}}));
  // 6 m hold six bars of 0.5 m and five gaps between them, 4 m long.
  EXPECT_EQ(count_bars(cover), 6u);
  EXPECT_NEAR(areas_of(cover, bounds).at("paint"), 6 * 0.5 * 4, 0.05);
  for (const mesh::PlaneArea& area : cover.find_part(bounds, {0, 0}).markings)
    for (const glm::dvec2& p : area.rings.at(0)) {
      EXPECT_NEAR(std::abs(p.x), 2, 1e-3);
      EXPECT_LE(std::abs(p.y), 2.75 + 1e-3) << "as far from both kerbs";
    }
}

TEST(Crossings, TagsSayWhetherANodeHasBars) {
  for (const osm::OsmTags& tags : {osm::OsmTags{{"crossing", "marked"}},
                                   {{"crossing", "uncontrolled"}},
                                   {{"crossing:markings", "zebra"}},
                                   {{"crossing:markings", "zebra:double"}},
                                   {{"crossing_ref", "zebra"}}})
    EXPECT_EQ(count_bars(paint(node(tags))), 6u);
  for (const osm::OsmTags& tags : {osm::OsmTags{},
                                   {{"crossing", "unmarked"}},
                                   {{"crossing", "traffic_signals"}},
                                   {{"crossing", "marked"}, {"crossing:markings", "lines"}},
                                   {{"crossing", "marked"}, {"crossing:markings", "no"}}})
    EXPECT_EQ(count_bars(paint(node(tags))), 0u);
}

TEST(Crossings, AWayThatSaysWhatIsPaintedCountsBeforeItsNode) {
  const auto crossing = [](osm::OsmTags tags) {
    tags.insert({{"highway", "footway"}, {"footway", "crossing"}});
    return osm::OsmWay{2, {{0, -3}, {0, 0}, {0, 3}}, std::move(tags)};
  };
  const osm::OsmPoint zebra = node({{"crossing", "zebra"}});
  EXPECT_EQ(count_bars(paint(zebra, {crossing({{"crossing", "zebra"}})})), 6u)
      << "of the way alone";
  EXPECT_EQ(count_bars(paint(zebra, {crossing({{"crossing", "unmarked"}})})), 0u);
  EXPECT_EQ(count_bars(paint(zebra, {crossing({})})), 6u) << "the way says nothing";
}

TEST(Crossings, ANodeWhereTwoWaysMeetIsPaintedOnce) {
  EXPECT_EQ(count_bars(paint(node({{"crossing", "zebra"}}), {street({{0, 0}, {0.001, 0}})})), 0u)
      << "three arms are a junction";
  const osm::OsmPoint zebra = node({{"crossing", "zebra"}});
  const std::vector<osm::OsmWay> ways{street({{-200, 0}, {0, 0}}), street({{0, 0}, {200, 0}})};
  Cover cover;
  add_markings({ways, {}, std::span(&zebra, 1)}, as_metres, bounds, cover);
  EXPECT_EQ(count_bars(cover), 6u);
}

TEST(Crossings, ANodeInTheMiddleOfAJunctionIsCounted) {
  const Cover cover = paint(node({{"crossing", "zebra"}}), {street({{0, 0}, {0, 200}})});
  EXPECT_EQ(count_bars(cover), 0u);
  EXPECT_EQ(cover.left_out.at("crossing in the middle of a junction"), 1u);
}

// OSM wiki, "Key:crossing:markings".
TEST(Crossings, LaddersAndListsHaveBars) {
  for (const char* bars : {"zebra", "zebra:double", "ladder", "ladder:skewed", "zebra;dots"})
    EXPECT_EQ(count_bars(paint(node({{"crossing:markings", bars}}))), 6u) << bars;
  for (const char* none : {"no", "yes", "lines", "dots;dashes", "surface", ""})
    EXPECT_EQ(count_bars(paint(node({{"crossing:markings", none}}))), 0u) << none;
  // The other tag says which kind they are.
  EXPECT_EQ(count_bars(paint(node({{"crossing", "uncontrolled"}, {"crossing:markings", "yes"}}))),
            6u);
  EXPECT_EQ(count_bars(paint(node({{"crossing", "unmarked"}, {"crossing:markings", "yes"}}))), 0u);
}

}  // namespace
}  // namespace nightcity::ground_cover
