#include "tools/map_lights/box_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace nightcity::map_lights {
namespace {

// A rectangle of 30 m x 10 m about (100, 50), turned, with points along its edges and inside.
std::vector<glm::dvec2> make_rectangle(double angle) {
  const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
  std::vector<glm::dvec2> points;
  for (const auto& [u, v] : std::vector<std::pair<double, double>>{
           {-1, -1}, {0, -1}, {1, -1}, {1, 0.3}, {1, 1}, {0.2, 0.1}, {-1, 1}})
    points.push_back(glm::dvec2(100, 50) + along * (15 * u) + across * (5 * v));
  return points;
}

TEST(BoxAround, ARectangleIsItsOwnBoxWhicheverWayItIsTurned) {
  for (double angle = -3; angle < 3; angle += 0.37) {
    const auto box = find_box(make_rectangle(angle));
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->length_m, 30, 1e-9);
    EXPECT_NEAR(box->width_m, 10, 1e-9);
    EXPECT_NEAR(glm::distance(box->centre, glm::dvec2(100, 50)), 0, 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(box->along, {std::cos(angle), std::sin(angle)})), 1, 1e-12);
  }
}

TEST(BoxAround, WhereTheOutlineBeginsDoesNotMatter) {
  std::vector<glm::dvec2> points = make_rectangle(0.7);
  const auto box = find_box(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    const auto same = find_box(points);
    EXPECT_EQ(same->centre, box->centre);
    EXPECT_EQ(same->along, box->along);
  }
}

TEST(BoxAround, ALineHasNoWidthAndAPointNoBox) {
  const std::vector<glm::dvec2> line{{0, 0}, {3, 4}, {6, 8}};
  ASSERT_TRUE(find_box(line));
  EXPECT_NEAR(find_box(line)->length_m, 10, 1e-12);
  EXPECT_NEAR(find_box(line)->width_m, 0, 1e-12);
  EXPECT_FALSE(find_box(std::vector<glm::dvec2>{{1, 1}, {1, 1}, {1, 1}}));
  EXPECT_FALSE(find_box(std::vector<glm::dvec2>{}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(find_box(std::vector<glm::dvec2>{{0, 0}, {nan, 1}, {2, 2}}));
}

}  // namespace
}  // namespace nightcity::map_lights
