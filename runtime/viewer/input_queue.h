// Mouse and keyboard events in the order in which they came, handed to the panel one change at a
// time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

struct ImGuiIO;

namespace nightcity::viewer {

struct InputEvent {
  enum class Kind { move, button, key, character, scroll, focus_lost };
  Kind kind = Kind::move;
  double time_s = 0;
  glm::vec2 at{0};    // move: cursor in window coordinates; scroll: notches, x and y
  int code = 0;       // button, key (GLFW_KEY_*) or character (Unicode)
  bool down = false;  // button, key
  int modifiers = 0;  // GLFW_MOD_* (key)
};

/// Tells how long keys were held, by the times of their events: independent of how often anyone
/// asks.
class HeldKeys {
 public:
  void press(int key, double time_s);
  void release(int key, double time_s);
  void release_all(double time_s);
  /// Returns the seconds for which `key` was held since the last take_all().
  double held_s(int key, double now_s) const;
  bool is_held(int key) const { return since_s_.count(key) != 0; }
  bool any() const { return !since_s_.empty(); }
  /// Starts to count anew.
  void take_all(double now_s);

 private:
  std::map<int, double> since_s_;   // of keys that are down
  std::map<int, double> before_s_;  // held and released since the last take_all()
};

/// Dear ImGui looks at its input once a frame. A click that began and ended between two frames, or
/// a key after a click, would be lost or out of order: so a frame gets events up to one change of a
/// button or key, and the next frame the next.
class InputQueue {
 public:
  void push(const InputEvent& event) { events_.push_back(event); }
  bool empty() const { return events_.empty(); }
  /// Returns the time up to which all events were handed over: that of the next one, or now.
  double handed_until(double now_s) const {
    return events_.empty() ? now_s : std::min(now_s, events_.front().time_s);
  }

  /// Hands the events of one frame to `io`, before ImGui::NewFrame(). Where a text box takes the
  /// keyboard, keys go to it alone.
  void feed(ImGuiIO& io);

  /// Returns the keys that the last feed() pressed and no text box took, as GLFW_KEY_*.
  const std::vector<int>& pressed() const { return pressed_; }
  /// Returns the modifiers of the last key event, GLFW_MOD_*.
  int modifiers() const { return modifiers_; }
  HeldKeys& held() { return held_; }

 private:
  // Returns whether a frame ends with this event.
  bool apply(const InputEvent& event, ImGuiIO& io);

  std::deque<InputEvent> events_;
  std::vector<int> pressed_;
  int modifiers_ = 0;
  glm::vec2 cursor_{-1e9f};
  bool buttons_[3]{};
  HeldKeys held_;
};

}  // namespace nightcity::viewer
