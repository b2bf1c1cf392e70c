// A gamepad's sticks and buttons as movements and keys.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "runtime/viewer/controls.h"
#include "runtime/viewer/keys.h"

namespace nightcity::viewer {

/// The state of a gamepad, as GLFW maps every known one: sticks -1 .. 1 (right and down are
/// positive), triggers -1 (released) .. 1.
struct PadState {
  glm::vec2 left{0}, right{0};
  float left_trigger = -1, right_trigger = -1;
  std::array<bool, 15> buttons{};  // by GLFW_GAMEPAD_BUTTON_*
};

/// Returns the state of the first gamepad, nothing where there is none. Needs GLFW to run.
std::optional<PadState> read_gamepad();

class Gamepad {
 public:
  /// Adds what the pad did in `elapsed_s` to the hands: the left stick moves ahead and to the
  /// sides, the right one turns, triggers go down and up, a bumper held makes all of it fast.
  /// Returns the keys that buttons stand for, once for each press: A the next way to move, B takes
  /// the last move back, X the clock, Y the panel, start the help.
  std::vector<Action> apply(const PadState& state, double elapsed_s, Hands& hands);

  /// Returns whether a stick or trigger is off its rest, or a button is down.
  static bool is_moved(const PadState& state);

 private:
  std::array<bool, 15> before_{};
};

}  // namespace nightcity::viewer
