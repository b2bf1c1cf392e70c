#include "tools/ground_cover/measured_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/ring_area.h"

namespace nightcity::ground_cover {
namespace {

const std::vector<glm::dvec2> corner{{0, 0}, {10, 0}, {10, 20}};

TEST(MeasuredLine, APartHasItsLengthAndTheBendsWithin) {
  const MeasuredLine along(corner);
  EXPECT_EQ(along.length_m(), 30);
  EXPECT_EQ(along.cut(4, 15), (std::vector<glm::dvec2>{{4, 0}, {10, 0}, {10, 5}}));
  EXPECT_EQ(along.cut(12, 15), (std::vector<glm::dvec2>{{10, 2}, {10, 5}}));
  EXPECT_EQ(along.cut(0, 30), corner);
}

TEST(MeasuredLine, LeftIsToTheLeftOfTheWayAlong) {
  const MeasuredLine along(corner);
  EXPECT_EQ(along.find_beside(4, 2), glm::dvec2(4, 2));
  EXPECT_EQ(along.find_beside(20, 2), glm::dvec2(8, 10));
  EXPECT_EQ(along.find_beside(20, -2), glm::dvec2(12, 10));
}

TEST(MeasuredLine, StripsAreMitredSoThatTheirAreaIsThatOfTheBand) {
  // Beside a right angle, a band of one metre is as long as the line at its own middle.
  const auto outer = make_strips(corner, -3, -2), inner = make_strips(corner, 2, 3);
  double outer_m2 = 0, inner_m2 = 0;
  for (const auto& strip : outer) outer_m2 += std::abs(signed_area(strip));
  for (const auto& strip : inner) inner_m2 += std::abs(signed_area(strip));
  EXPECT_NEAR(outer_m2, 30 + 2 * 2.5, 1e-12);
  EXPECT_NEAR(inner_m2, 30 - 2 * 2.5, 1e-12);
  EXPECT_EQ(outer[0][1], outer[1][0]) << "neighbours share their corners";
  EXPECT_EQ(outer[0][2], outer[1][3]);
}

TEST(MeasuredLine, SharpBendsHaveFiniteCorners) {
  for (const auto& strip : make_strips({{0, 0}, {10, 0}, {0, 0}, {0, 0}, {5, 1e-9}}, 1, 2))
    for (const glm::dvec2& p : strip) EXPECT_LT(std::hypot(p.x, p.y), 15);
  EXPECT_TRUE(make_strips({{0, 0}}, 1, 2).empty());
}

}  // namespace
}  // namespace nightcity::ground_cover
