#include "tools/bridges/deck_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nightcity::bridges {
namespace {

constexpr DeckRules street{0.08, 250};

// A course over level ground, which a clearance crosses in its middle.
DeckCourse make_course(double length_m, double height_m = 5.3) {
  DeckCourse course;
  course.length_m = length_m;
  course.ground_m.assign(static_cast<std::size_t>(length_m) + 1, 0.0);
  course.first_m = course.last_m = 0;
  course.clearances = {{length_m / 2 - 4, length_m / 2 + 4, height_m, 3.3}};
  return course;
}

TEST(DeckProfile, ReachesTheClearHeightAndKeepsGradientAndCrest) {
  std::string reason;
  const auto profile = find_profile(make_course(200), street, reason);
  ASSERT_TRUE(profile) << reason;
  EXPECT_FALSE(profile->is_low);
  const auto& z = profile->heights_m;
  for (int s = 96; s <= 104; ++s) EXPECT_NEAR(z[static_cast<std::size_t>(s)], 5.3, 1e-9);
  for (std::size_t i = 1; i < z.size(); ++i) EXPECT_LE(std::abs(z[i] - z[i - 1]), 0.08 + 1e-9);
  for (std::size_t i = 1; i + 1 < z.size(); ++i)
    EXPECT_GE(z[i - 1] - 2 * z[i] + z[i + 1], -1 / 250.0 - 1e-9) << "curvature of the crest";
  // The tangent from (0, 0) to the crest h - (96 - s)^2 / 500 has the slope m with
  // 125 m^2 - 96 m + 5.3 = 0.
  const double slope = (96 - std::sqrt(96.0 * 96.0 - 500 * 5.3)) / 250;
  EXPECT_NEAR(z[1], slope, 1e-3);
}

TEST(DeckProfile, IsAStraightLineOverAValley) {
  DeckCourse course = make_course(100);
  course.clearances.clear();
  course.last_m = 3;
  for (std::size_t i = 1; i < 100; ++i) course.ground_m[i] = -10;
  std::string reason;
  const auto profile = find_profile(course, street, reason);
  ASSERT_TRUE(profile);
  for (std::size_t i = 0; i <= 100; ++i)
    EXPECT_NEAR(profile->heights_m[i], 0.03 * static_cast<double>(i), 1e-9);
}

TEST(DeckProfile, IsLowWhereTheGradientAllowsNoMore) {
  std::string reason;
  const auto profile = find_profile(make_course(120), street, reason);
  ASSERT_TRUE(profile);
  EXPECT_TRUE(profile->is_low);
  // The steepest line touches the crest: 0.08 * 56 - 250 * 0.08^2 / 2.
  EXPECT_NEAR(profile->heights_m[60], 3.68, 1e-9);
  EXPECT_FALSE(find_profile(make_course(60), street, reason));
  EXPECT_EQ(reason, "too short to rise above what it crosses");
}

TEST(DeckProfile, IsLevelBeyondAFreeEnd) {
  DeckCourse course = make_course(200);
  course.first_m = course.last_m = std::nullopt;
  std::string reason;
  const auto profile = find_profile(course, street, reason);
  ASSERT_TRUE(profile);
  for (const double z : profile->heights_m) EXPECT_NEAR(z, 5.3, 1e-9);
}

TEST(DeckProfile, SteepAbutmentsAreRefused) {
  DeckCourse course = make_course(100);
  course.clearances.clear();
  course.last_m = 8.1;
  std::string reason;
  EXPECT_FALSE(find_profile(course, street, reason));
  EXPECT_EQ(reason, "steeper than allowed from end to end");
}

TEST(DeckProfile, LiesAboveTheGroundEverywhere) {
  DeckCourse course = make_course(100);
  course.clearances.clear();
  for (std::size_t i = 0; i <= 100; ++i)
    course.ground_m[i] = std::sin(static_cast<double>(i) * 0.2) - 0.01 * static_cast<double>(i);
  course.first_m = course.ground_m.front();
  course.last_m = course.ground_m.back();
  const DeckRules steep{1, 250};
  std::string reason;
  const auto profile = find_profile(course, steep, reason);
  ASSERT_TRUE(profile);
  for (std::size_t i = 0; i <= 100; ++i)
    EXPECT_GE(profile->heights_m[i], *course.ground_m[i] - 1e-9);
}

}  // namespace
}  // namespace nightcity::bridges
