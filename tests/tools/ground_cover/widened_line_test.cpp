#include "tools/ground_cover/widened_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/mesh/owner_finder.h"

namespace nightcity::ground_cover {
namespace {

double area_of(const std::vector<Ring>& rings) {
  double sum = 0;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      sum += (a.x * b.y - a.y * b.x) / 2;
    }
  return std::abs(sum);
}

constexpr double twelve_corners = 3.0;  // area of a regular polygon of 12 in the unit circle

TEST(WidenedLine, IsARectangleWithRoundEnds) {
  Widener widener;
  const std::vector<glm::dvec2> line{{0, 0}, {100, 0}};
  EXPECT_NEAR(area_of(widener.widen(line, 3)), 600 + 9 * twelve_corners, 1e-6);
}

TEST(WidenedLine, LiesOnOneSide) {
  Widener widener;
  const std::vector<glm::dvec2> line{{0, 0}, {100, 0}};
  for (const auto side : {Widener::Side::left, Widener::Side::right}) {
    const auto rings = widener.widen(line, 3, side);
    EXPECT_NEAR(area_of(rings), 300, 1e-6);
    for (const glm::dvec2& p : rings.at(0))
      EXPECT_TRUE(side == Widener::Side::left ? p.y > -1e-9 : p.y < 1e-9);
  }
}

TEST(WidenedLine, ALoopLeavesItsMiddleFree) {
  Widener widener;
  std::vector<glm::dvec2> circle;
  for (int i = 0; i <= 64; ++i)
    circle.emplace_back(20 * std::cos(i * M_PI / 32), 20 * std::sin(i * M_PI / 32));
  const auto rings = widener.widen(circle, 3);
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_FALSE(mesh::holds(rings, {0, 0}));
  EXPECT_TRUE(mesh::holds(rings, {20, 0}));
}

TEST(WidenedLine, BadLinesHaveNoArea) {
  Widener widener;
  const double nan = std::nan("");
  EXPECT_TRUE(widener.widen({}, 3).empty());
  EXPECT_TRUE(widener.widen(std::vector<glm::dvec2>{{1, 1}}, 3).empty());
  EXPECT_TRUE(widener.widen(std::vector<glm::dvec2>{{1, 1}, {1, 1}}, 3).empty());
  EXPECT_TRUE(widener.widen(std::vector<glm::dvec2>{{nan, 1}, {1, nan}, {2, 2}}, 3).empty());
  EXPECT_TRUE(widener.widen(std::vector<glm::dvec2>{{0, 0}, {9, 0}}, nan).empty());
}

}  // namespace
}  // namespace nightcity::ground_cover
