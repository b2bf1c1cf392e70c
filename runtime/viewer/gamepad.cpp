#include "runtime/viewer/gamepad.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace nightcity::viewer {
namespace {

constexpr float rest = 0.15f;            // of a stick that nobody holds
constexpr float turning_px_per_s = 500;  // of a mouse that is dragged
constexpr double longest_s = 0.25;       // a pad that was not asked for longer moved no longer

// Returns a stick's place beyond its rest, 0 .. 1, finer near the middle.
glm::vec2 beyond_rest(const glm::vec2& stick) {
  const float length = glm::length(stick);
  if (!(length > rest)) return glm::vec2(0);
  const float share = std::min(1.0f, (length - rest) / (1 - rest));
  return stick / length * share * share;
}

// Returns how far a trigger is pressed, 0 .. 1.
double pressed(float trigger) {
  const double share = (double(trigger) + 1) / 2;
  return share > double(rest) ? std::min(share, 1.0) : 0;
}

constexpr std::pair<int, Action> meanings[] = {{GLFW_GAMEPAD_BUTTON_A, Action::next_motion},
                                               {GLFW_GAMEPAD_BUTTON_B, Action::undo_move},
                                               {GLFW_GAMEPAD_BUTTON_X, Action::play},
                                               {GLFW_GAMEPAD_BUTTON_Y, Action::panel},
                                               {GLFW_GAMEPAD_BUTTON_START, Action::help}};

}  // namespace

std::optional<PadState> read_gamepad() {
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    GLFWgamepadstate found;
    if (!glfwJoystickIsGamepad(id) || !glfwGetGamepadState(id, &found)) continue;
    PadState state;
    state.left = {found.axes[GLFW_GAMEPAD_AXIS_LEFT_X], found.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]};
    state.right = {found.axes[GLFW_GAMEPAD_AXIS_RIGHT_X], found.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]};
    state.left_trigger = found.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER];
    state.right_trigger = found.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER];
    for (std::size_t i = 0; i < state.buttons.size(); ++i)
      state.buttons[i] = found.buttons[i] == GLFW_PRESS;
    return state;
  }
  return std::nullopt;
}

bool Gamepad::is_moved(const PadState& state) {
  return beyond_rest(state.left) != glm::vec2(0) || beyond_rest(state.right) != glm::vec2(0) ||
         pressed(state.left_trigger) > 0 || pressed(state.right_trigger) > 0 ||
         std::find(state.buttons.begin(), state.buttons.end(), true) != state.buttons.end();
}

std::vector<Action> Gamepad::apply(const PadState& state, double elapsed_s, Hands& hands) {
  const double s = std::clamp(elapsed_s, 0.0, longest_s);
  const glm::vec2 move = beyond_rest(state.left), turn = beyond_rest(state.right);
  hands.held_s +=
      s * glm::dvec3(double(move.x), pressed(state.right_trigger) - pressed(state.left_trigger),
                     -double(move.y));
  hands.drag += turn * (turning_px_per_s * float(s));
  hands.fast |= state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] ||
                state.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER];
  std::vector<Action> actions;
  for (const auto& [button, action] : meanings) {
    const auto at = static_cast<std::size_t>(button);
    if (state.buttons[at] && !before_[at]) actions.push_back(action);
  }
  before_ = state.buttons;
  return actions;
}

}  // namespace nightcity::viewer
