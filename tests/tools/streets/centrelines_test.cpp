// Centrelines of shapes for which they are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "formats/error.h"
#include "tools/streets/centrelines.h"
#include "tools/streets/road_shapes.h"

namespace nightcity::streets {
namespace {

using glm::dvec2;
using test::circle;
using test::strip;

std::vector<Centreline> lines_of(const std::vector<RoadSurface>& surfaces) {
  return find_centrelines(chordal_axis(road_outline(surfaces), 2.5));
}

double length_of(const std::vector<dvec2>& line) {
  double sum = 0;
  for (std::size_t n = 1; n < line.size(); ++n) sum += glm::distance(line[n - 1], line[n]);
  return sum;
}

double from_segment(const dvec2& p, const dvec2& a, const dvec2& b) {
  const dvec2 d = b - a;
  return glm::distance(p, a + d * std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0));
}

/// Counts how often each node is an end of a line.
std::map<std::size_t, int> ends_of(const std::vector<Centreline>& lines) {
  std::map<std::size_t, int> ends;
  for (const Centreline& line : lines) ++ends[line.from], ++ends[line.to];
  return ends;
}

std::size_t junctions_of(const std::vector<Centreline>& lines) {
  const auto ends = ends_of(lines);
  return static_cast<std::size_t>(
      std::count_if(ends.begin(), ends.end(), [](const auto& end) { return end.second > 2; }));
}

TEST(CentreLines, OfAVeryLongRoadIsItsMiddleToo) {
  const dvec2 a(400123.4, 5800456.7), b = a + dvec2(7200, 5400);
  const auto lines = lines_of({strip(a, b, 6)});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].width_m, 6, 0.05);
  EXPECT_NEAR(length_of(lines[0].line), 9000, 0.1);
  for (const dvec2& p : lines[0].line) EXPECT_LT(from_segment(p, a, b), 0.1);
}

TEST(CentreLines, PointsOfALongEdgeAreInsertedFromTheCoarseToTheFine) {
  EXPECT_EQ(list_insertions(3), (std::vector<std::size_t>{0, 1, 2, 3}));
  for (const std::size_t parts : {257u, 512u, 3600u}) {
    std::vector<std::size_t> order = list_insertions(parts);
    EXPECT_EQ(order[0], 0u);
    EXPECT_EQ(order[1], parts);
    // Wherever it stops, no gap is more than four times as long as a mean one.
    for (std::size_t n = 4; n <= order.size(); n *= 2) {
      std::vector<std::size_t> there(order.begin(), order.begin() + static_cast<long>(n));
      std::sort(there.begin(), there.end());
      for (std::size_t i = 1; i < n; ++i)
        EXPECT_LE(there[i] - there[i - 1], 4 * parts / n + 1) << parts << " " << n;
    }
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k <= parts; ++k) EXPECT_EQ(order.at(k), k);
    EXPECT_EQ(order.size(), parts + 1);
  }
}

TEST(CentreLines, RoadsBeyondTheLimitOfPointsAreRefusedByItsName) {
  const std::vector<OutlineEdge> outline = road_outline(std::vector{strip({0, 0}, {100, 0}, 10)});
  EXPECT_FALSE(chordal_axis(outline, 2.5, 88).branches.empty());  // 2 * 40 and 2 * 4
  try {
    chordal_axis(outline, 2.5, 87);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("[city] max_road_points"), std::string::npos);
  }
}

class StraightRoad : public testing::TestWithParam<double> {};

TEST_P(StraightRoad, GivesItsMiddleLineFromEndToEndAndItsWidth) {
  const double width = GetParam();
  const dvec2 a(400123.4, 5800456.7),
      b = a + dvec2(90, 50);  // as far from zero as real eastings are
  const auto lines = lines_of({strip(a, b, width)});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].width_m, width, 0.05);
  EXPECT_NEAR(length_of(lines[0].line), glm::distance(a, b), 0.1);
  for (const dvec2& p : lines[0].line) EXPECT_LT(from_segment(p, a, b), 0.1);
  EXPECT_LT(
      std::min(glm::distance(lines[0].line.front(), a), glm::distance(lines[0].line.back(), a)),
      0.1);
  EXPECT_LT(
      std::min(glm::distance(lines[0].line.front(), b), glm::distance(lines[0].line.back(), b)),
      0.1);
}

INSTANTIATE_TEST_SUITE_P(Widths, StraightRoad, testing::Values(2.8, 4.0, 6.0, 11.0, 22.0));

TEST(MiddleLines, SurfacesSideBySideAreOneRoad) {
  // Two lanes side by side with a gap of 4 cm, cut into pieces at different places.
  const std::vector<RoadSurface> surfaces = {strip({0, 0}, {60, 0}, 3), strip({60, 0}, {140, 0}, 3),
                                             strip({0, 3.04}, {33, 3.04}, 3),
                                             strip({33, 3.04}, {140, 3.04}, 3)};
  const auto lines = lines_of(surfaces);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].width_m, 6.04, 0.1);
  for (const dvec2& p : lines[0].line) EXPECT_NEAR(p.y, 1.52, 0.15);
}

TEST(MiddleLines, NearlyStraightOuterEdgesGetNoHairOfTheirOwn) {
  // The outer edge of this street bends in by 20 cm. The thin triangle of the convex hull there
  // is no gap.
  const RoadSurface street{{{0, 0}, {100, 0.2}, {200, 0}, {200, 7}, {0, 7}}, {}, nullptr, true};
  const auto lines = lines_of({street});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(length_of(lines[0].line), 200, 0.2);
}

TEST(MiddleLines, SurfacesThatOverlapAreOneRoad) {
  const auto lines = lines_of({strip({0, 0}, {80, 0}, 6), strip({50, 0}, {140, 0}, 6)});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(length_of(lines[0].line), 140, 0.2);
}

TEST(MiddleLines, ACrossIsOneJunctionWithFourArms) {
  for (const double minor : {3.0, 6.0, 9.0}) {
    const auto lines = lines_of({strip({-80, 0}, {80, 0}, 7), strip({10, -60}, {10, 60}, minor)});
    ASSERT_EQ(lines.size(), 4u) << minor;
    const auto ends = ends_of(lines);
    EXPECT_EQ(ends.size(), 5u);
    EXPECT_EQ(junctions_of(lines), 1u);
    for (const Centreline& line : lines) {
      const bool at_start = ends.at(line.from) == 4;
      EXPECT_EQ(ends.at(at_start ? line.from : line.to), 4);
      EXPECT_LT(glm::distance(at_start ? line.line.front() : line.line.back(), dvec2(10, 0)), 0.5)
          << minor;
      for (const dvec2& p : line.line)
        EXPECT_LT(std::min(std::abs(p.y), std::abs(p.x - 10)), 0.5) << "at " << p.x << ", " << p.y;
    }
  }
}

TEST(MiddleLines, ASideStreetMeetsInOneJunctionWithThreeArms) {
  const auto lines = lines_of({strip({-80, 0}, {80, 0}, 7), strip({0, 0}, {30, 60}, 5)});
  EXPECT_EQ(lines.size(), 3u);
  EXPECT_EQ(junctions_of(lines), 1u);
}

TEST(MiddleLines, LinesThatMeetShareTheirEndsToTheBit) {
  const auto lines = lines_of({strip({-80, 0}, {80, 0}, 7), strip({10, -60}, {10, 60}, 5)});
  std::map<std::size_t, dvec2> places;
  for (const Centreline& line : lines)
    for (const bool start : {true, false}) {
      const auto [found, is_new] = places.try_emplace(start ? line.from : line.to,
                                                      start ? line.line.front() : line.line.back());
      EXPECT_EQ(found->second, start ? line.line.front() : line.line.back());
    }
}

TEST(MiddleLines, ARingGivesALoop) {
  RoadSurface ring{circle({0, 0}, 23, 60), {circle({0, 0}, 17, 60)}, nullptr, true};
  const auto lines = lines_of({ring});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].from, lines[0].to);
  EXPECT_EQ(lines[0].line.front(), lines[0].line.back());
  EXPECT_NEAR(lines[0].width_m, 6, 0.3);
  EXPECT_NEAR(length_of(lines[0].line), 2 * std::numbers::pi * 20, 4);
  for (const dvec2& p : lines[0].line) EXPECT_NEAR(glm::length(p), 20, 0.5);
}

TEST(MiddleLines, ARoundaboutWithThreeRoadsHasThreeJunctions) {
  std::vector<RoadSurface> surfaces = {
      {circle({0, 0}, 23, 60), {circle({0, 0}, 16, 60)}, nullptr, true}};
  for (const double angle : {0.3, 2.2, 4.4}) {
    const dvec2 out(std::cos(angle), std::sin(angle));
    surfaces.push_back(strip(out * 20.0, out * 100.0, 6));
  }
  const auto lines = lines_of(surfaces);
  EXPECT_EQ(lines.size(), 6u);
  EXPECT_EQ(junctions_of(lines), 3u);
}

TEST(MiddleLines, BaysAndCornersAreNoStreets) {
  std::vector<RoadSurface> surfaces = {strip({0, 0}, {120, 0}, 6)};
  for (const double x : {20.0, 47.0, 81.0}) surfaces.push_back(strip({x, 0}, {x, 7}, 4));
  const auto lines = lines_of(surfaces);
  ASSERT_EQ(lines.size(), 1u);
  for (const dvec2& p : lines[0].line) EXPECT_LT(std::abs(p.y), 1.2);
}

TEST(MiddleLines, ASmallIslandIsDrivenRoundAndALargeOneParts) {
  RoadSurface road = strip({0, 0}, {160, 0}, 12);
  road.interiors = {strip({70, 0}, {76, 0}, 3).exterior};
  EXPECT_EQ(lines_of({road}).size(), 1u);
  road.interiors = {strip({50, 0}, {110, 0}, 3).exterior};
  EXPECT_EQ(lines_of({road}).size(), 4u);
}

TEST(MiddleLines, BrokenRingsAreSurvived) {
  const PlanRing bow_tie = {{0, 0}, {40, 30}, {40, 0}, {0, 30}};
  const PlanRing twice = {{0, 0}, {50, 0}, {50, 6}, {0, 6}, {0, 0}, {50, 0}, {50, 6}, {0, 6}};
  const PlanRing needle = {{0, 0}, {100, 0}, {100, 1e-9}};
  for (const PlanRing& ring : {bow_tie, twice, needle}) {
    const auto lines = lines_of({{ring, {}, nullptr, true}, strip({200, 0}, {260, 0}, 6)});
    EXPECT_GE(lines.size(), 1u);
    for (const Centreline& line : lines)
      for (const dvec2& p : line.line) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  }
  EXPECT_TRUE(lines_of({}).empty());
}

}  // namespace
}  // namespace nightcity::streets
