// Lines that are joined, simplified and told apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tools/ground_cover/join_lines.h"
#include "tools/names/lines_apart.h"
#include "tools/simplify_line.h"

namespace nightcity::names {
namespace {

double find_length(const Line& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += glm::distance(line[i - 1], line[i]);
  return length;
}

TEST(JoinLines, PiecesOfAStreetBecomeOneLineInAnyOrderAndDirection) {
  std::vector<Line> pieces;
  for (int i = 0; i < 6; ++i)
    pieces.push_back({{10.0 * i, 0}, {10.0 * i + 5, 3}, {10.0 * i + 10, 0}});
  const std::vector<Line> straight = ground_cover::join_lines(pieces);
  ASSERT_EQ(straight.size(), 1u);
  EXPECT_EQ(straight[0].size(), 13u);
  EXPECT_NEAR(find_length(straight[0]), 12 * std::hypot(5, 3), 1e-9);
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    std::shuffle(pieces.begin(), pieces.end(), random);
    std::reverse(pieces[0].begin(), pieces[0].end());
    EXPECT_EQ(ground_cover::join_lines(pieces), straight);
  }
}

TEST(JoinLines, AForkIsNotJoinedAndALoopEnds) {
  const Line stem{{0, 0}, {10, 0}}, left{{10, 0}, {20, 5}}, right{{10, 0}, {20, -5}};
  EXPECT_EQ(ground_cover::join_lines({stem, left, right}).size(), 3u);
  const Line half{{0, 0}, {5, 5}, {10, 0}}, other{{0, 0}, {5, -5}, {10, 0}};
  const std::vector<Line> ring = ground_cover::join_lines({half, other});
  ASSERT_EQ(ring.size(), 1u);
  EXPECT_EQ(ring[0].size(), 5u);
  EXPECT_EQ(ring[0].front(), ring[0].back());
  EXPECT_EQ(ground_cover::join_lines({ring[0]}), ring);
  EXPECT_EQ(ground_cover::join_lines({{{1, 1}}}).size(), 1u);  // a point
}

TEST(SimplifyLine, KeepsWithinTheToleranceAndTheEnds) {
  Line arc;
  for (int i = 0; i <= 5000; ++i)
    arc.push_back(100.0 * glm::dvec2(std::cos(i * M_PI / 5000), std::sin(i * M_PI / 5000)));
  const Line simple = simplify_line(arc, 1);
  EXPECT_EQ(simple.front(), arc.front());
  EXPECT_EQ(simple.back(), arc.back());
  // A chord whose sagitta is 1 m on a circle of 100 m spans 2 acos(0.99), so that half a circle
  // takes 12; splitting in halves, and at each thousandth point, takes up to twice as many.
  EXPECT_LE(simple.size(), 25u);
  for (std::size_t i = 1; i < simple.size(); ++i)
    EXPECT_GE(glm::length(0.5 * (simple[i - 1] + simple[i])), 99 - 1e-9);
  EXPECT_EQ(simplify_line({{0, 0}, {5, 0.5}, {10, 0}}, 1).size(), 2u);
  EXPECT_EQ(simplify_line({{0, 0}, {5, 1.5}, {10, 0}}, 1).size(), 3u);
  EXPECT_EQ(simplify_line({{0, 0}, {5, 5}, {0, 0}}, 1).size(), 3u);  // there and back
}

TEST(LinesApart, AreGroupedByPlaceWhateverTheirNumber) {
  const auto near = [](double x, double y) { return Line{{x, y}, {x + 100, y}}; };
  // Two towns 5 km apart; in one of them a street whose parts follow each other, 200 m apart.
  const std::vector<Line> lines{near(0, 0),   near(5000, 0), near(300, 0),
                                near(600, 0), near(900, 0),  near(1200, 0)};
  const auto groups = group_lines_apart(lines);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].size(), 5u);
  EXPECT_EQ(groups[1].size(), 1u);
  // A line of a few points is known along all of its way.
  EXPECT_EQ(group_lines_apart({{{0, 0}, {20'000, 0}}, near(10'000, 200)}).size(), 1u);
  EXPECT_TRUE(group_lines_apart({}).empty());
}

}  // namespace
}  // namespace nightcity::names
