#include "tools/lights/lighting_class.h"

#include <gtest/gtest.h>

namespace nightcity::lights {
namespace {

TEST(LightingClass, HoldsTheStandardsFigures) {
  EXPECT_EQ(lighting_class("P1")->average_lx, 15);
  EXPECT_EQ(lighting_class("P4")->average_lx, 5);
  EXPECT_EQ(lighting_class("P4")->min_lx, 1);
  EXPECT_EQ(lighting_class("C5")->uniformity, 0.4);
  EXPECT_EQ(lighting_class("M3")->average_lx, lighting_class("C3")->average_lx);
  EXPECT_FALSE(lighting_class("P7"));
  EXPECT_FALSE(lighting_class(""));
}

}  // namespace
}  // namespace nightcity::lights
