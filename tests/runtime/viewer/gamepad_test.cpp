#include "runtime/viewer/gamepad.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::viewer {
namespace {

TEST(Gamepad, SticksMoveAndTurnForAsLongAsTheyAreHeld) {
  Gamepad pad;
  PadState state;
  EXPECT_FALSE(Gamepad::is_moved(state));
  state.left = {0, -1};  // ahead
  state.right = {1, 0};
  EXPECT_TRUE(Gamepad::is_moved(state));
  Hands hands;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(pad.apply(state, 0.1, hands).empty());
  EXPECT_NEAR(hands.held_s.z, 1, 1e-6);
  EXPECT_NEAR(hands.held_s.x, 0, 1e-6);
  EXPECT_GT(hands.drag.x, 100);
  EXPECT_EQ(hands.drag.y, 0);
  Hands late;
  pad.apply(state, 1e9, late);  // after a pause
  EXPECT_LE(late.held_s.z, 0.25);
}

TEST(Gamepad, ASticksRestIsNoMovementAndTriggersGoDownAndUp) {
  Gamepad pad;
  PadState state;
  state.left = {0.1f, 0.1f};
  state.right = {NAN, 0};
  EXPECT_FALSE(Gamepad::is_moved(state));
  Hands hands;
  pad.apply(state, 0.1, hands);
  EXPECT_EQ(hands.held_s, glm::dvec3(0));
  EXPECT_EQ(hands.drag, glm::vec2(0));
  state.right_trigger = 1;
  pad.apply(state, 0.2, hands);
  EXPECT_NEAR(hands.held_s.y, 0.2, 1e-6);
  state.left_trigger = 1;
  pad.apply(state, 0.2, hands);
  EXPECT_NEAR(hands.held_s.y, 0.2, 1e-6);
}

TEST(Gamepad, ButtonsCountOnceForEachPress) {
  Gamepad pad;
  PadState state;
  Hands hands;
  state.buttons[GLFW_GAMEPAD_BUTTON_A] = true;
  EXPECT_EQ(pad.apply(state, 0.1, hands), std::vector{Action::next_motion});
  EXPECT_TRUE(pad.apply(state, 0.1, hands).empty());
  state.buttons[GLFW_GAMEPAD_BUTTON_A] = false;
  EXPECT_TRUE(pad.apply(state, 0.1, hands).empty());
  state.buttons[GLFW_GAMEPAD_BUTTON_A] = state.buttons[GLFW_GAMEPAD_BUTTON_X] = true;
  EXPECT_EQ(pad.apply(state, 0.1, hands), (std::vector{Action::next_motion, Action::play}));
  EXPECT_FALSE(hands.fast);
  state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] = true;
  pad.apply(state, 0.1, hands);
  EXPECT_TRUE(hands.fast);
}

}  // namespace
}  // namespace nightcity::viewer
