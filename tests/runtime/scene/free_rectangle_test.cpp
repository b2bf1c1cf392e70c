#include "runtime/scene/free_rectangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace nightcity::scene {
namespace {

using Corners = std::array<glm::vec3, 3>;

// Returns whether a place on the map lies inside a triangle, and not on its edge.
bool is_inside(const glm::vec2& p, const Corners& t) {
  int signs = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 &a = t[i], &b = t[(i + 1) % 3];
    const float side = (b.x - a.x) * (p.y - a.z) - (b.z - a.z) * (p.x - a.x);
    signs += side > 1e-3f ? 1 : side < -1e-3f ? -1 : 0;
  }
  return std::abs(signs) == 3;
}

TEST(FreeRectangle, KeepsAllOfItWhereTrianglesOnlyTouchIt) {
  FreeRectangle free({-10, -5}, {10, 5});
  free.leave_out({glm::vec3(10, 0, -5), glm::vec3(10, 0, 5), glm::vec3(90, 0, 0)});
  free.leave_out({glm::vec3(-50, 0, 5), glm::vec3(50, 0, 5), glm::vec3(0, 0, 80)});
  free.leave_out({glm::vec3(20, 0, 20), glm::vec3(30, 0, 20), glm::vec3(20, 0, 30)});
  EXPECT_EQ(free.lower(), glm::vec2(-10, -5));
  EXPECT_EQ(free.upper(), glm::vec2(10, 5));
}

TEST(FreeRectangle, LosesTheSmallestSideThatATriangleReachesInto) {
  FreeRectangle free({-10, -5}, {10, 5});
  free.leave_out({glm::vec3(8, 0, 0), glm::vec3(40, 0, -3), glm::vec3(40, 0, 3)});
  EXPECT_EQ(free.upper(), glm::vec2(8, 5));
  free.leave_out({glm::vec3(0, 0, -4), glm::vec3(-3, 0, -30), glm::vec3(3, 0, -30)});
  EXPECT_EQ(free.lower(), glm::vec2(-10, -4));
}

// The box of this triangle covers a quarter of the rectangle, and it does not reach into it.
TEST(FreeRectangle, IsNotCutByTheBoxOfATriangle) {
  FreeRectangle free({-10, -10}, {10, 10});
  free.leave_out({glm::vec3(25, 0, 0), glm::vec3(25, 0, 25), glm::vec3(0, 0, 25)});
  EXPECT_EQ(free.upper(), glm::vec2(10, 10));
}

TEST(FreeRectangle, IsEmptyUnderATriangleThatCoversIt) {
  FreeRectangle free({-1, -1}, {1, 1});
  free.leave_out({glm::vec3(-90, 0, -90), glm::vec3(90, 0, -90), glm::vec3(0, 0, 90)});
  EXPECT_TRUE(free.empty());
  free.leave_out({glm::vec3(-90, 0, -90), glm::vec3(90, 0, -90), glm::vec3(0, 0, 90)});
  EXPECT_TRUE(free.empty());
}

TEST(FreeRectangle, HoldsNoPlaceOfAnyTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> in(-30, 30);
  int kept = 0;
  for (int i = 0; i < 200; ++i) {
    FreeRectangle free({-20, -15}, {20, 15});
    std::vector<Corners> triangles;
    for (int k = 0; k < 4; ++k) {
      Corners& t = triangles.emplace_back();
      for (glm::vec3& p : t) p = {in(random), in(random), in(random)};
      free.leave_out(t);
    }
    if (free.empty()) continue;
    ++kept;
    EXPECT_GE(free.lower().x, -20);
    EXPECT_LE(free.upper().y, 15);
    for (int x = 1; x < 20; ++x)
      for (int z = 1; z < 20; ++z) {
        const glm::vec2 share(float(x) / 20, float(z) / 20),
            p = free.lower() + share * (free.upper() - free.lower());
        for (const Corners& t : triangles) ASSERT_FALSE(is_inside(p, t)) << i;
      }
  }
  EXPECT_GT(kept, 50);
}

}  // namespace
}  // namespace nightcity::scene
