#include "runtime/viewer/controls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/markers.h"
#include "support/scenes.h"

namespace nightcity::viewer {
namespace {

const glm::vec2 window{1280, 720};

// Level ground with a house 10 m high, 20 m north of the origin.
scene::RenderScene with_a_house() {
  return test::SceneBuilder().ground(200).box({-10, 0, -30}, {10, 10, -20}).with({});
}

CameraControl at(const glm::vec3& position, const glm::vec3& target) {
  CameraControl control;
  control.pose.position = position;
  control.pose.target = target;
  return control;
}

glm::vec2 pixel_of(const scene::CameraPose& pose, const glm::vec3& point) {
  const auto at = scene::project(scene::make_camera(pose, window.x / window.y), point);
  return at ? *at * window : glm::vec2(-1);
}

TEST(Controls, ThePointUnderAPixelIsThatOfTheSurface) {
  const scene::RenderScene scene = with_a_house();
  const CameraControl control = at({0, 5, 30}, {0, 5, -100});
  const auto point = find_point(scene, control.pose, window / 2.0f, window);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->z, -20, 1e-3);
  EXPECT_NEAR(point->y, 5, 1e-3);
  EXPECT_FALSE(find_point(scene, control.pose, {640, 10}, window));  // the sky
}

TEST(Controls, ADragOrbitsAboutThePointThatWasPressed) {
  const scene::RenderScene scene = with_a_house();
  CameraControl control = at({30, 40, 30}, {0, 0, 0});
  const glm::vec3 corner(10, 10, -20);
  const glm::vec2 pressed = pixel_of(control.pose, corner);
  move_camera(control, {.cursor = pressed, .pressed = true}, scene, window);
  ASSERT_TRUE(control.pivot);
  EXPECT_LT(glm::distance(*control.pivot, corner), 0.5f);
  const float distance = glm::distance(control.pose.position, *control.pivot);
  const glm::vec3 before = control.pose.position;
  for (int i = 0; i < 20; ++i)
    move_camera(control, {.drag = {9, -2}, .cursor = pressed}, scene, window);
  EXPECT_GT(glm::distance(control.pose.position, before), 5.0f);
  EXPECT_NEAR(glm::distance(control.pose.position, *control.pivot), distance, 0.01f * distance);
  // It stays where it is in the picture.
  EXPECT_LT(glm::distance(pixel_of(control.pose, *control.pivot), pressed), 3.0f);
}

TEST(Controls, TheWheelComesNearerToWhatIsUnderTheCursorWhichStaysThere) {
  const scene::RenderScene scene = with_a_house();
  CameraControl control = at({30, 40, 30}, {0, 0, 0});
  const glm::vec3 corner(10, 10, -20);
  const glm::vec2 cursor = pixel_of(control.pose, corner);
  for (int i = 0; i < 60; ++i) move_camera(control, {.scroll = 1, .cursor = cursor}, scene, window);
  EXPECT_LT(glm::distance(control.pose.position, corner), 1.0f);
  EXPECT_LT(glm::distance(pixel_of(control.pose, corner), cursor), 30.0f);
}

TEST(Controls, PanningKeepsTheHeightAndTheGroundUnderTheCursor) {
  const scene::RenderScene scene = with_a_house();
  CameraControl control = at({0, 60, 60}, {0, 0, 0});
  const glm::vec2 pressed = window / 2.0f;
  move_camera(control, {.cursor = pressed, .pressed = true}, scene, window);
  const glm::vec3 point = *control.pivot;
  move_camera(control, {.pan = {40, -25}, .cursor = pressed}, scene, window);
  EXPECT_NEAR(control.pose.position.y, 60, 1e-4);
  EXPECT_LT(glm::distance(pixel_of(control.pose, point), pressed + glm::vec2(40, -25)), 3.0f);
}

TEST(Controls, FlyingCoversItsDistanceAtAnyFrameRate) {
  const scene::RenderScene scene = with_a_house();
  for (const int frames : {1, 8, 400}) {
    CameraControl control = at({100, 15, 100}, {100, 15, 0});
    control.motion = Motion::fly;
    for (int i = 0; i < frames; ++i)
      move_camera(control, {.held_s = {0, 0, 4.0 / frames}}, scene, window);
    EXPECT_NEAR(control.pose.position.z, 60, 0.01) << frames;  // 10 m/s for 4 s
  }
}

TEST(Controls, FlyingHighIsFaster) {
  CameraControl control;
  EXPECT_EQ(find_speed(control, 10.0f), 10);
  EXPECT_EQ(find_speed(control, 200.0f), 100);
  EXPECT_EQ(find_speed(control, std::nullopt), 10);
  control.speed_by_height = false;
  EXPECT_EQ(find_speed(control, 200.0f), 10);
  control.speed_m_s = 1e38f;
  EXPECT_EQ(find_speed(control, 0.0f), 500);
}

TEST(Controls, NoMotionLeavesTheWorldOrMakesTheCameraUnusable) {
  const scene::RenderScene scene = with_a_house();
  CameraControl control = at({0, 5, 0}, {0, 5, -10});
  control.motion = Motion::fly;
  const float bad = std::nanf("");
  for (const Hands& hands :
       {Hands{.held_s = {0, 0, 1e30}}, Hands{.drag = {bad, 0}}, Hands{.pan = {1e30f, 1e30f}},
        Hands{.held_s = {0, double(bad), 0}}, Hands{.scroll = 1e9f}}) {
    move_camera(control, hands, scene, window);
    EXPECT_NO_THROW(scene::make_camera(control.pose, 1.5f));
    EXPECT_LE(glm::length(control.pose.position), 2e5f);
    EXPECT_TRUE(std::isfinite(control.pose.position.x + control.pose.target.z));
  }
}

TEST(Controls, WalkingKeepsTheEyeAboveTheGroundAndOutOfWalls) {
  const scene::RenderScene scene = with_a_house();
  CameraControl control = at({0, 50, 0}, {0, 0, -10});
  control.motion = Motion::walk;
  begin_to_walk(control, scene);
  EXPECT_NEAR(control.pose.position.y, eye_height_m, 1e-4);
  EXPECT_NEAR(control.pose.target.y, eye_height_m, 1e-4);
  move_camera(control, {.held_s = {0, 0, 5}}, scene, window);
  EXPECT_NEAR(control.pose.position.z, -7, 0.01);  // 1.4 m/s for 5 s
  for (int i = 0; i < 20; ++i)
    move_camera(control, {.held_s = {0, 0, 5}, .fast = true}, scene, window);
  EXPECT_LT(control.pose.position.z, -19.0f);  // at the wall, 20 m north
  EXPECT_GT(control.pose.position.z, -20.0f);
  EXPECT_NEAR(control.pose.position.y, eye_height_m, 1e-4);
}

TEST(Controls, WalkersClimbKerbsAndStairsButNoRoofs) {
  test::SceneBuilder builder;
  builder.ground(100);
  for (int i = 0; i < 5; ++i)  // stairs of 30 cm
    builder.box({-5, 0, -4.0f - float(i)}, {5, 0.3f * float(i + 1), -3.0f - float(i)});
  const scene::RenderScene scene = builder.with({});
  CameraControl control = at({0, 1.7f, 0}, {0, 1.7f, -10});
  control.motion = Motion::walk;
  move_camera(control, {.held_s = {0, 0, 7.5 / 1.4}}, scene, window);
  EXPECT_NEAR(control.pose.position.z, -7.5, 0.02);
  EXPECT_NEAR(control.pose.position.y, 1.5 + 1.7, 0.01);
}

TEST(Controls, TheCameraSaysWhereItIsAndWhichWayItLooks) {
  scene::RenderScene scene = with_a_house();
  scene.georeference.origin = {390000, 5819000, 30};
  const glm::vec3 eye(100, 24, -50);
  const auto looking = [&](const glm::vec3& way) {
    return describe_camera(scene, at(eye, eye + way).pose);
  };
  EXPECT_EQ(looking({0, -1, -10}), "390100 E, 5819050 N, 24.0 m up, looking north");
  EXPECT_TRUE(looking({10, 0, 0}).ends_with("looking east"));
  EXPECT_TRUE(looking({0, 0, 10}).ends_with("looking south"));
  EXPECT_TRUE(looking({-10, 0, 0.1f}).ends_with("looking west"));
  EXPECT_TRUE(looking({-10, 0, -10}).ends_with("looking north-west"));
}

TEST(Controls, WalkersStopAtTheEdgeOfTheModel) {
  const scene::RenderScene scene = test::SceneBuilder().ground(10).with({});
  CameraControl control = at({0, 1.7f, 0}, {0, 1.7f, -10});
  control.motion = Motion::walk;
  move_camera(control, {.held_s = {0, 0, 60}}, scene, window);
  EXPECT_NEAR(control.pose.position.z, -10, 0.2);
}

}  // namespace
}  // namespace nightcity::viewer
