// Input without a window: events come from the test, and Dear ImGui takes them.
#include "runtime/viewer/input_queue.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "runtime/viewer/hands.h"

namespace nightcity::viewer {
namespace {

using Kind = InputEvent::Kind;

TEST(HeldKeys, CountSecondsHoweverOftenTheyAreAsked) {
  HeldKeys often, seldom;
  double sum = 0;
  for (HeldKeys* keys : {&often, &seldom}) keys->press(GLFW_KEY_W, 1.0);
  for (int i = 1; i <= 400; ++i) {
    sum += often.held_s(GLFW_KEY_W, 1 + 0.01 * i);
    often.take_all(1 + 0.01 * i);
  }
  EXPECT_NEAR(sum, 4, 1e-9);
  EXPECT_NEAR(seldom.held_s(GLFW_KEY_W, 5.0), 4, 1e-9);
}

TEST(HeldKeys, TapsBetweenTwoFramesCount) {
  HeldKeys keys;
  for (int i = 0; i < 10; ++i) {
    keys.press(GLFW_KEY_W, i);
    keys.release(GLFW_KEY_W, i + 0.1);
  }
  EXPECT_NEAR(keys.held_s(GLFW_KEY_W, 20), 1, 1e-9);
  EXPECT_FALSE(keys.any());
  keys.take_all(20);
  EXPECT_EQ(keys.held_s(GLFW_KEY_W, 30), 0);
  keys.press(GLFW_KEY_A, 31);
  keys.release_all(32);  // the window lost the focus
  EXPECT_EQ(keys.held_s(GLFW_KEY_A, 40), 1);
}

class Queue : public testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 600};
    io.DeltaTime = 1.0f / 60;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = -1;
    io.KeyMap[ImGuiKey_Enter] = GLFW_KEY_ENTER;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    for (int i = 0; i < 3; ++i) frame();
  }
  void TearDown() override { ImGui::DestroyContext(); }

  // A panel with a button and a text box in the upper left corner.
  void frame() {
    queue.feed(ImGui::GetIO());
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    if (ImGui::Checkbox("box", &ticked)) ++changes;
    box = (ImGui::GetItemRectMin().x + 5);
    box_y = (ImGui::GetItemRectMin().y + 5);
    ImGui::InputFloat("value", &value);
    value_y = ImGui::GetItemRectMin().y + 5;
    value_x = ImGui::GetItemRectMin().x + 5;
    ImGui::End();
    for (const int key : queue.pressed()) keys.push_back(key);
    const Hands now = read_hands(ImGui::GetIO(), queue.held(), queue.handed_until(time_s));
    clicks += now.clicked;
    hands.drag += now.drag;
    hands.pan += now.pan;
    hands.scroll += now.scroll;
    hands.held_s += now.held_s;
    ImGui::Render();
  }
  void drain() {
    do frame();
    while (!queue.empty());
    frame();
  }
  void move(float x, float y) { queue.push({.kind = Kind::move, .at = {x, y}}); }
  void button(bool down, int code = 0) {
    queue.push({.kind = Kind::button, .code = code, .down = down});
  }
  void key(int code, bool down, double at_s = 0) {
    queue.push({.kind = Kind::key, .time_s = at_s, .code = code, .down = down});
  }
  void click(float x, float y) {
    move(x, y);
    button(true);
    button(false);
  }

  InputQueue queue;
  bool ticked = false;
  int changes = 0, clicks = 0;
  float value = 0, box = 0, box_y = 0, value_x = 0, value_y = 0;
  std::vector<int> keys;
  Hands hands;
  double time_s = 0;
};

// The whole click lies between two frames, and the pointer is elsewhere at the second.
TEST_F(Queue, QuickClicksAreAllObeyed) {
  for (int i = 0; i < 8; ++i) {
    click(box, box_y);
    move(700, 500);
  }
  drain();
  EXPECT_EQ(changes, 8);
}

TEST_F(Queue, ClicksAndKeysKeepTheirOrder) {
  key(GLFW_KEY_2, true);
  key(GLFW_KEY_2, false);
  click(box, box_y);
  key(GLFW_KEY_P, true);
  key(GLFW_KEY_P, false);
  frame();
  EXPECT_EQ(keys, (std::vector<int>{GLFW_KEY_2}));
  EXPECT_EQ(changes, 0);
  drain();
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(keys, (std::vector<int>{GLFW_KEY_2, GLFW_KEY_P}));
}

// Everything is typed before the first frame: box, text, Enter, and a shortcut after it.
TEST_F(Queue, WhatIsTypedIntoABoxIsNoShortcut) {
  click(value_x, value_y);
  move(value_x, value_y);
  button(true);  // a double click selects what is in the box
  button(false);
  for (const char c : {'5', '.', '2'}) {
    key(c == '.' ? GLFW_KEY_PERIOD : GLFW_KEY_0 + (c - '0'), true);
    queue.push({.kind = Kind::character, .code = c});
    key(c == '.' ? GLFW_KEY_PERIOD : GLFW_KEY_0 + (c - '0'), false);
  }
  key(GLFW_KEY_ENTER, true);
  key(GLFW_KEY_ENTER, false);
  drain();
  EXPECT_EQ(keys, std::vector<int>{});
  EXPECT_NEAR(value, 5.2f, 1e-5);
  key(GLFW_KEY_5, true);
  key(GLFW_KEY_5, false);
  drain();
  EXPECT_EQ(keys, (std::vector<int>{GLFW_KEY_5}));
}

TEST_F(Queue, ADragIsCountedFromPressToReleaseAndNotOverThePanel) {
  move(400, 300);
  button(true);
  move(420, 310);
  move(440, 330);
  button(false);
  move(700, 500);
  drain();
  EXPECT_EQ(hands.drag, glm::vec2(40, 30));
  EXPECT_EQ(clicks, 0);
  EXPECT_EQ(hands.pan, glm::vec2(0));
  hands = {};
  move(box, box_y);
  button(true);
  move(box + 100, box_y + 300);
  button(false);
  drain();
  EXPECT_EQ(hands.drag, glm::vec2(0));
}

TEST_F(Queue, APressAndReleaseInOnePlaceIsAClickAndADragIsNone) {
  click(400, 300);
  drain();
  EXPECT_EQ(clicks, 1);
  click(box, box_y);  // the panel's
  move(400, 300);
  button(true);
  move(440, 300);  // the motion and the release come in one frame
  button(false);
  move(400, 300);
  button(true);
  move(500, 300);  // there and back
  drain();
  move(400, 300);
  drain();
  button(false);
  drain();
  EXPECT_EQ(clicks, 1);
}

TEST_F(Queue, TheRightButtonPansAndTheWheelScrolls) {
  move(400, 300);
  button(true, 1);
  move(410, 300);
  button(false, 1);
  queue.push({.kind = Kind::scroll, .at = {0, 2}});
  queue.push({.kind = Kind::scroll, .at = {0, 1}});
  drain();
  EXPECT_EQ(hands.pan, glm::vec2(10, 0));
  EXPECT_EQ(hands.scroll, 3);
}

TEST_F(Queue, AKeyHeldMovesByItsTime) {
  key(GLFW_KEY_W, true, 10);
  key(GLFW_KEY_W, false, 14);
  key(GLFW_KEY_A, true, 14);
  key(GLFW_KEY_A, false, 14.5);
  time_s = 20;
  drain();
  EXPECT_NEAR(hands.held_s.z, 4, 1e-9);
  EXPECT_NEAR(hands.held_s.x, -0.5, 1e-9);
}

TEST_F(Queue, LosingTheFocusReleasesWhatWasHeld) {
  key(GLFW_KEY_W, true, 1);
  move(400, 300);
  button(true);
  queue.push({.kind = Kind::focus_lost, .time_s = 2});
  move(500, 300);
  time_s = 9;
  drain();
  EXPECT_NEAR(hands.held_s.z, 1, 1e-9);
  EXPECT_EQ(hands.drag, glm::vec2(0));
}

}  // namespace
}  // namespace nightcity::viewer
