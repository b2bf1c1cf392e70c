#include "formats/hierarchy/wall_directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace nightcity::hierarchy {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Adds the two triangles of a wall of a length, 10 m high, whose run is at an angle to the x axis.
void add_wall(WallDirections& directions, double angle_deg, float length) {
  const float x = length * float(std::cos(angle_deg * degree)),
              z = length * float(std::sin(angle_deg * degree));
  const Float4 a{5, 0, 7, 0}, b{5 + x, 0, 7 + z, 0}, c{5 + x, 10, 7 + z, 0}, d{5, 10, 7, 0};
  directions.add({a, b, c});
  directions.add({a, c, d});
}

double angle_of(const BoxFrame& frame) {
  return std::atan2(double(frame.along.y), double(frame.along.x)) / degree;
}

// The distance between two directions of which a quarter turn makes no difference.
double apart(double a, double b) {
  return std::abs(std::remainder(a - b, 90.0));
}

TEST(WallDirections, FindsThatOfACityAtAnyAngle) {
  for (double angle = -87; angle < 90; angle += 7.3) {
    WallDirections directions;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> in(-0.5, 0.5);
    for (int i = 0; i < 400; ++i) add_wall(directions, angle + 90 * (i % 4) + in(random), 12);
    for (int i = 0; i < 60; ++i) add_wall(directions, 360 * in(random), 12);
    const BoxFrame frame = directions.find_frame();
    // Along the axes, or nearly so, a turn is not worth it.
    if (frame.is_turned())
      EXPECT_LT(apart(angle_of(frame), angle), 0.2) << angle;
    else
      EXPECT_LT(apart(0, angle), 1) << angle;
    EXPECT_NEAR(frame.along.x * frame.along.x + frame.along.y * frame.along.y, 1, 1e-6);
  }
}

TEST(WallDirections, TurnsNothingWithoutWallsOrWithWallsOfEveryDirection) {
  WallDirections none, all, along_axes;
  none.add({Float4{0, 0, 0, 0}, Float4{9, 0, 1, 0}, Float4{1, 0.1f, 9, 0}});  // a street
  EXPECT_FALSE(none.find_frame().is_turned());
  for (int i = 0; i < 720; ++i) add_wall(all, i, 10);
  EXPECT_FALSE(all.find_frame().is_turned());
  for (int i = 0; i < 8; ++i) add_wall(along_axes, 90 * i, 10);
  EXPECT_FALSE(along_axes.find_frame().is_turned());
}

TEST(WallDirections, CountsLargeWallsForMore) {
  WallDirections directions;
  for (int i = 0; i < 100; ++i) add_wall(directions, 50, 1);
  for (int i = 0; i < 10; ++i) add_wall(directions, 20, 100);
  EXPECT_LT(apart(angle_of(directions.find_frame()), 20), 0.2);
}

TEST(WallDirections, PassesOverWhatIsNotFinite) {
  WallDirections directions;
  for (int i = 0; i < 10; ++i) add_wall(directions, 30, 10);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  directions.add({Float4{nan, 0, 0, 0}, Float4{1, 0, 1, 0}, Float4{1, 9, 1, 0}});
  directions.add({Float4{infinite, 0, 0, 0}, Float4{1, 0, 1, 0}, Float4{1, 9, 1, 0}});
  EXPECT_LT(apart(angle_of(directions.find_frame()), 30), 0.2);
}

}  // namespace
}  // namespace nightcity::hierarchy
