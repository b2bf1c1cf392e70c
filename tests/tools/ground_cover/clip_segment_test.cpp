#include "tools/ground_cover/clip_segment.h"

#include <gtest/gtest.h>

#include <vector>

namespace nightcity::ground_cover {
namespace {

TEST(ClipSegment, IsThePartWithinTheBox) {
  const Box box{{0, 0}, {10, 10}};
  EXPECT_EQ(clip_segment({-5, 5}, {15, 5}, box), std::pair(0.25, 0.75));
  EXPECT_EQ(clip_segment({2, 2}, {8, 8}, box), std::pair(0.0, 1.0));
  EXPECT_FALSE(clip_segment({-5, 20}, {15, 20}, box));
  EXPECT_FALSE(clip_segment({-5, 8}, {8, 25}, box)) << "it passes a corner";
  EXPECT_FALSE(clip_segment({12, 0}, {12, 10}, box));
  const auto long_one = clip_segment({-1e9, 5}, {1e9, 5}, box);
  ASSERT_TRUE(long_one);
  EXPECT_NEAR((long_one->second - long_one->first) * 2e9, 10, 1e-3);
}

TEST(ClipSegment, TheLengthOfALineIsThatOfItsPartsWithinTheBox) {
  const std::vector<glm::dvec2> line{{-5, 5}, {5, 5}, {5, 20}, {8, 20}, {8, 4}};
  EXPECT_NEAR(find_length_m(line, {{0, 0}, {10, 10}}), 5 + 5 + 6, 1e-12);
  EXPECT_EQ(find_length_m({}, {{0, 0}, {10, 10}}), 0);
}

}  // namespace
}  // namespace nightcity::ground_cover
