// Rectangles on the outline of a wall.
#include "tools/lights/wall_plane.h"

#include <gtest/gtest.h>

namespace nightcity::lights {
namespace {

TEST(WallPlane, RectanglesAreInsideWhollyOrNotAtAll) {
  const WallOutline u_shape{{{0, 0}, {10, 0}, {10, 10}, {7, 10}, {7, 4}, {3, 4}, {3, 10}, {0, 10}},
                            {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}},
                            {0, 0},
                            {10, 10}};
  EXPECT_TRUE(contains(u_shape, {0.5, 5}, {2.5, 9}));
  EXPECT_TRUE(contains(u_shape, {3, 0.5}, {9, 3.5}));
  EXPECT_FALSE(contains(u_shape, {4, 5}, {6, 9}));        // in the gap
  EXPECT_FALSE(contains(u_shape, {1, 5}, {9, 6}));        // both corners inside, the middle not
  EXPECT_FALSE(contains(u_shape, {0.5, 0.5}, {2.5, 3}));  // holds the hole
  EXPECT_FALSE(contains(u_shape, {1.2, 1.2}, {1.8, 1.8}));
  EXPECT_FALSE(contains(u_shape, {-1, 5}, {2, 9}));
}

}  // namespace
}  // namespace nightcity::lights
