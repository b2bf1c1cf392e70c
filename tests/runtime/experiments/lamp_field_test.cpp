#include "runtime/experiments/lamp_field.h"

#include <gtest/gtest.h>

namespace nightcity::experiments {
namespace {

TEST(LampField, HasTheLampsAskedForAndAllShine) {
  for (const std::size_t lamps : {1ul, 10ul, 1000ul}) {
    const scene::RenderScene scene = make_lamp_field(lamps);
    EXPECT_EQ(scene.lights.size(), lamps);
    EXPECT_EQ(scene.bad_lights, 0u);
  }
}

}  // namespace
}  // namespace nightcity::experiments
