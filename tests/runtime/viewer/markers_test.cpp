#include "runtime/scene/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/scene/camera.h"
#include "support/scenes.h"

namespace nightcity::viewer {
namespace {

// A camera at the origin that looks north, with a view 90 degrees high and twice as wide.
gpu::Camera camera() {
  scene::CameraPose pose;
  pose.position = {0, 0, 0};
  pose.target = {0, 0, -1};
  pose.fov_deg = 90;
  return scene::make_camera(pose, 2.0f);
}

TEST(Markers, PointAheadIsInTheMiddle) {
  const auto at = scene::project(camera(), {0, 0, -7});
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 0.5f, 1e-6);
  EXPECT_NEAR(at->y, 0.5f, 1e-6);
}

TEST(Markers, CornersOfTheViewAreCornersOfTheWindow) {
  // tan(45 deg) = 1: at depth 5 the view is 10 m high and 20 m wide.
  const auto upper_left = scene::project(camera(), {-10, 5, -5}),
             lower_right = scene::project(camera(), {10, -5, -5});
  ASSERT_TRUE(upper_left && lower_right);
  EXPECT_NEAR(upper_left->x, 0.0f, 1e-5);
  EXPECT_NEAR(upper_left->y, 0.0f, 1e-5);
  EXPECT_NEAR(lower_right->x, 1.0f, 1e-5);
  EXPECT_NEAR(lower_right->y, 1.0f, 1e-5);
}

TEST(Markers, NothingBehindTheEyeOrAtIt) {
  EXPECT_FALSE(scene::project(camera(), {0, 0, 7}));
  EXPECT_FALSE(scene::project(camera(), {0, 0, 0}));
  EXPECT_FALSE(scene::project(camera(), {std::nanf(""), 0, std::nanf("")}));
}

TEST(Markers, OnlyLightsInTheWindowNearestLast) {
  const std::vector<Light> lights{test::lamp({0, 0, -10}, 1), test::lamp({0, 0, 10}, 1),
                                  test::lamp({0, 0, -30}, 1), test::lamp({0, 80, -10}, 1),
                                  test::lamp({1, 0, -20}, 1)};
  const auto markers = scene::find_markers(camera(), lights, 100);
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].light, 2u);
  EXPECT_EQ(markers[1].light, 4u);
  EXPECT_EQ(markers[2].light, 0u);
  EXPECT_NEAR(markers[2].distance, 10.0f, 1e-5);
}

TEST(Markers, WhereTheyAreTooManyTheNearestStay) {
  std::vector<Light> lights;
  for (int i = 50; i > 0; --i) lights.push_back(test::lamp({0, 0, static_cast<float>(-i)}, 1));
  const auto markers = scene::find_markers(camera(), lights, 5);
  ASSERT_EQ(markers.size(), 5u);
  EXPECT_NEAR(markers.front().distance, 5.0f, 1e-5);
  EXPECT_NEAR(markers.back().distance, 1.0f, 1e-5);
}

}  // namespace
}  // namespace nightcity::viewer
