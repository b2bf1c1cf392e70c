#include "tools/ground_cover/clip_ring.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::ground_cover {
namespace {

double area_of(const std::vector<glm::dvec2>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

TEST(ClipRing, KeepsTheAreaInside) {
  const std::vector<glm::dvec2> triangle{{0, 0}, {10, 0}, {0, 10}};
  EXPECT_NEAR(area_of(clip_ring(triangle, {0, 0}, {5, 5})), 25, 1e-12);
  EXPECT_NEAR(area_of(clip_ring(triangle, {-1, -1}, {20, 20})), 50, 1e-12);
  EXPECT_NEAR(area_of(clip_ring(triangle, {4, 4}, {9, 9})), 2, 1e-12);
  EXPECT_TRUE(clip_ring(triangle, {11, 11}, {12, 12}).empty());
}

TEST(ClipRing, NeighboursMeetInTheVerySamePoint) {
  const std::vector<glm::dvec2> ring{{0.1, 0.3}, {9.7, 3.1}, {4.2, 8.8}};
  std::vector<glm::dvec2> reversed(ring.rbegin(), ring.rend());
  const auto right = clip_ring(ring, {5, -100}, {100, 100});
  const auto left = clip_ring(reversed, {-100, -100}, {5, 100});
  int met = 0;
  for (const glm::dvec2& a : right)
    for (const glm::dvec2& b : left)
      if (a.x == 5 && b.x == 5 && std::abs(a.y - b.y) < 1e-12) ++met;
  EXPECT_EQ(met, 2);
}

}  // namespace
}  // namespace nightcity::ground_cover
