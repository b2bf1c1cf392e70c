#include "tools/ground_cover/street_areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tools/mesh/partition.h"

namespace nightcity::ground_cover {
namespace {

// Degrees stand for metres here.
const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
constexpr Box bounds{{-500, -500}, {500, 500}};

osm::OsmWay way(std::vector<glm::dvec2> line, osm::OsmTags tags) {
  return {1, std::move(line), std::move(tags)};
}

Cover make_cover(const std::vector<osm::OsmWay>& ways, bool markings = false) {
  Cover cover;
  add_streets(ways, as_metres, bounds, cover);
  if (markings) add_markings(ways, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

// The area of each kind within a rectangle, m2, and of paint on carriageways.
std::map<std::string, double> areas_of(const Cover& cover, const Box& box) {
  const CoverPart part = cover.find_part(box, {0, 0});
  const std::vector<mesh::PlaneLayer> layers{part.areas, part.markings};
  const mesh::PlanePartition plan = mesh::partition(layers);
  std::map<std::string, double> areas;
  for (const auto& t : plan.triangles) {
    const glm::dvec2 a = plan.points[t.vertex[0]], b = plan.points[t.vertex[1]] - a,
                     c = plan.points[t.vertex[2]] - a;
    const double area = (b.x * c.y - b.y * c.x) / 2;
    const auto& owners = plan.owners[t.region];
    if (owners[0] == mesh::no_label) continue;
    const Surface& surface = cover.surfaces()[owners[0]];
    areas[find_material(surface.kind).name] += area;
    if (surface.marked && owners[1] != mesh::no_label) areas["paint"] += area;
    if (surface.sunken) areas["sunken"] += area;
  }
  return areas;
}

constexpr Box middle{{-50, -40}, {50, 40}};  // 100 m of a street along x

TEST(StreetAreas, AStreetIsAsWideAsTheRoadTableSaysAndHasPavements) {
  const auto areas =
      areas_of(make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}})}), middle);
  EXPECT_NEAR(areas.at("asphalt"), 100 * 5.5, 0.1);  // two lanes of 2.75 m
  EXPECT_NEAR(areas.at("sunken"), 100 * 5.5, 0.1);
  EXPECT_NEAR(areas.at("paving stones"), 100 * 2 * 2.5, 0.2);
}

TEST(StreetAreas, TagsSayWhatRunsBesideIt) {
  const auto widths = [](osm::OsmTags tags) {
    tags["highway"] = "residential";
    auto areas = areas_of(make_cover({way({{-200, 0}, {200, 0}}, std::move(tags))}), middle);
    return std::pair(areas["asphalt"] / 100, areas["paving stones"] / 100);
  };
  EXPECT_NEAR(widths({{"sidewalk", "no"}}).second, 0, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk", "separate"}}).second, 0, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk", "left"}}).second, 2.5, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk:both", "yes"}}).second, 5, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk:right", "yes"}, {"sidewalk:right:width", "4 m"}}).second, 6.5,
              1e-2);
  EXPECT_NEAR(widths({{"cycleway", "track"}}).first, 5.5 + 2 * 2, 1e-2);
  EXPECT_NEAR(widths({{"cycleway:right", "track"}, {"sidewalk", "no"}}).first, 7.5, 1e-2);
  EXPECT_NEAR(widths({{"surface", "paving_stones"}, {"sidewalk", "no"}}).second, 5.5, 1e-2);
}

TEST(StreetAreas, JunctionsAreFilledAndCountOnce) {
  const Cover cover =
      make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}, {"sidewalk", "no"}}),
                  way({{0, -200}, {0, 200}}, {{"highway", "residential"}, {"sidewalk", "no"}})});
  EXPECT_NEAR(areas_of(cover, middle).at("asphalt"), 100 * 5.5 + 80 * 5.5 - 5.5 * 5.5, 0.1);
}

TEST(StreetAreas, TheMoreImportantRoadIsSeenWhereTwoCross) {
  const auto areas = areas_of(
      make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}, {"surface", "sett"}}),
                  way({{0, -200}, {0, 200}}, {{"highway", "primary"}, {"surface", "concrete"}})}),
      middle);
  EXPECT_NEAR(areas.at("concrete"), 80 * 6.5, 0.1);
  EXPECT_NEAR(areas.at("sett"), (100 - 6.5) * 5.5, 0.1);
}

TEST(StreetAreas, TunnelsAreLeftOutAndCounted) {
  const Cover cover = make_cover(
      {way({{-200, 0}, {200, 0}}, {{"highway", "primary"}, {"tunnel", "yes"}}),
       way({{-200, 9}, {200, 9}}, {{"highway", "service"}, {"tunnel", "building_passage"}})});
  EXPECT_EQ(cover.left_out.at("street in a tunnel or a building"), 1u);
  EXPECT_EQ(cover.areas().size(), 1u);
}

TEST(StreetAreas, ValuesWithoutATagAreCounted) {
  const Cover cover =
      make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}}),
                  way({{-200, 9}, {200, 9}}, {{"highway", "footway"}, {"surface", "asphalt"}})});
  EXPECT_EQ(cover.assumed.at("surface of a street"), 1u);
  EXPECT_EQ(cover.assumed.at("pavement beside a street"), 1u);
}

TEST(StreetAreas, LivingStreetsAreLevel) {
  EXPECT_EQ(
      areas_of(make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "living_street"}})}), middle)
          .count("sunken"),
      0u);
}

TEST(StreetAreas, WaysOutsideTheGroundCostNothing) {
  EXPECT_TRUE(make_cover({way({{-900, 900}, {900, 900}}, {{"highway", "primary"}})}).empty());
}

TEST(StreetAreas, AMarkedCrossingHasBarsOnTheCarriagewayOnly) {
  // 20 m across a street of 6.5 m: ten bars and ten gaps a metre apart, 4 m long.
  const auto areas = areas_of(
      make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "primary"}, {"lane_markings", "no"}}),
                  way({{0, -10}, {0, 10}},
                      {{"highway", "footway"}, {"footway", "crossing"}, {"crossing", "zebra"}})},
                 true),
      middle);
  EXPECT_NEAR(areas.at("paint"), 6.5 * 4 / 2, 1.01);  // a bar may lie astride the kerb
}

TEST(StreetAreas, LanesArePartedByDashes) {
  const auto areas = areas_of(
      make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "primary"}, {"lanes", "4"}})}, true),
      middle);
  // Three lines, a third of whose length is painted.
  EXPECT_NEAR(areas.at("paint"), 3 * 0.12 * 100 / 3, 3 * 0.12 * 3);
  EXPECT_EQ(
      areas_of(make_cover({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}})}, true), middle)
          .count("paint"),
      0u);
}

TEST(StreetAreas, HostileWaysEndWithACount) {
  const double nan = std::nan("");
  const Cover cover = make_cover(
      {way({{nan, nan}, {nan, nan}}, {{"highway", "primary"}}),
       way({{0, 0}, {0, 0}}, {{"highway", "primary"}}),
       way({{-1e9, 0}, {1e9, 0}, {0, 1e9}}, {{"highway", "primary"}, {"sidewalk", "no"}}),
       way({{0, 0}, {10, 0}, {0, 0}, {10, 0}, {5, 5}, {5, -5}}, {{"highway", "footway"}})},
      true);
  EXPECT_GE(cover.left_out.size(), 1u);
  areas_of(cover, middle);
}

}  // namespace
}  // namespace nightcity::ground_cover
