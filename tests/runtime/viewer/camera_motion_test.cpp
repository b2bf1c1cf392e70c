#include "runtime/viewer/camera_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace nightcity::viewer {
namespace {

constexpr float quarter_turn = std::numbers::pi_v<float> / 2;

// A camera ten metres south of the origin and ten metres high that looks at it.
scene::CameraPose southern() {
  scene::CameraPose pose;
  pose.position = {0, 10, 10};
  pose.target = {0, 0, 0};
  return pose;
}

float elevation_deg(const scene::CameraPose& pose) {
  return glm::degrees(std::asin(glm::normalize(pose.target - pose.position).y));
}

void expect_near(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_NEAR(a.x, b.x, 1e-4);
  EXPECT_NEAR(a.y, b.y, 1e-4);
  EXPECT_NEAR(a.z, b.z, 1e-4);
}

TEST(CameraMotion, OrbitingAQuarterCounterClockwiseFromSouthEndsEast) {
  const scene::CameraPose pose = orbited(southern(), quarter_turn, 0);
  expect_near(pose.position, {10, 10, 0});
  expect_near(pose.target, {0, 0, 0});
}

TEST(CameraMotion, TurningAQuarterLeftFromNorthLooksWest) {
  scene::CameraPose north;
  north.position = {3, 2, 1};
  north.target = {3, 2, -9};
  const scene::CameraPose pose = turned(north, quarter_turn, 0);
  expect_near(pose.position, north.position);
  expect_near(pose.target, {-7, 2, 1});
}

TEST(CameraMotion, OrbitKeepsDistanceAndTargetTurnKeepsDistanceAndEye) {
  scene::CameraPose orbit = southern(), turn = southern();
  for (int i = 0; i < 200; ++i) {
    orbit = orbited(orbit, 0.37f, 0.21f * static_cast<float>(i % 3 - 1));
    turn = turned(turn, -0.29f, 0.17f * static_cast<float>(i % 5 - 2));
  }
  expect_near(orbit.target, southern().target);
  expect_near(turn.position, southern().position);
  EXPECT_NEAR(glm::distance(orbit.position, orbit.target), std::sqrt(200.0f), 1e-2);
  EXPECT_NEAR(glm::distance(turn.position, turn.target), std::sqrt(200.0f), 1e-2);
}

TEST(CameraMotion, PitchRaisesTheEyeOrTheViewAndStopsBeforeThePole) {
  EXPECT_GT(orbited(southern(), 0, 0.1f).position.y, 10.0f);
  EXPECT_GT(turned(southern(), 0, 0.1f).target.y, 0.0f);
  EXPECT_NEAR(elevation_deg(orbited(southern(), 0, 10)), -max_elevation_deg, 1e-2);
  EXPECT_NEAR(elevation_deg(orbited(southern(), 0, -10)), max_elevation_deg, 1e-2);
  EXPECT_NEAR(elevation_deg(turned(southern(), 0, 10)), max_elevation_deg, 1e-2);
}

TEST(CameraMotion, MapKeepsItsHeadingWhenFirstTurned) {
  scene::CameraPose map;  // looks straight down, east at the top of the picture
  map.position = {0, 100, 0};
  map.target = {0, 0, 0};
  map.up = {1, 0, 0};
  const scene::CameraPose pose = orbited(map, 0, -0.3f);
  EXPECT_LT(pose.position.x, -1.0f);  // the camera sinks on the west side and looks east
  EXPECT_NEAR(pose.position.z, 0.0f, 1e-3);
  EXPECT_EQ(pose.up, glm::vec3(0, 1, 0));
}

TEST(CameraMotion, MovingFollowsTheViewsOwnAxes) {
  scene::CameraPose north;
  north.position = {0, 2, 0};
  north.target = {0, 2, -10};
  expect_near(moved(north, {1, 0, 0}).position, {1, 2, 0});  // right is east
  expect_near(moved(north, {0, 1, 0}).position, {0, 3, 0});
  expect_near(moved(north, {0, 0, 1}).position, {0, 2, -1});  // forward is north
  expect_near(moved(north, {1, 2, 3}).target, {1, 4, -13});
}

TEST(CameraMotion, DollyScalesTheDistanceWithinLimits) {
  const float distance = std::sqrt(200.0f);
  EXPECT_NEAR(glm::length(dollied(southern(), 0.5f).position), 0.5f * distance, 1e-4);
  EXPECT_NEAR(glm::length(dollied(southern(), 1e-9f).position), 0.5f, 1e-4);
  EXPECT_NEAR(glm::length(dollied(southern(), 1e9f).position), 1e5f, 10.0f);
}

}  // namespace
}  // namespace nightcity::viewer
