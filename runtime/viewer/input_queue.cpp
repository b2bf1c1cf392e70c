#include "runtime/viewer/input_queue.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <iterator>

namespace nightcity::viewer {

void HeldKeys::press(int key, double time_s) {
  since_s_.try_emplace(key, time_s);
}

void HeldKeys::release(int key, double time_s) {
  const auto down = since_s_.find(key);
  if (down == since_s_.end()) return;
  before_s_[key] += std::max(0.0, time_s - down->second);
  since_s_.erase(down);
}

void HeldKeys::release_all(double time_s) {
  while (!since_s_.empty()) release(since_s_.begin()->first, time_s);
}

double HeldKeys::held_s(int key, double now_s) const {
  const auto before = before_s_.find(key);
  const auto since = since_s_.find(key);
  return (before == before_s_.end() ? 0 : before->second) +
         (since == since_s_.end() ? 0 : std::max(0.0, now_s - since->second));
}

void HeldKeys::take_all(double now_s) {
  before_s_.clear();
  for (auto& [key, since_s] : since_s_) since_s = std::max(since_s, now_s);
}

void InputQueue::feed(ImGuiIO& io) {
  pressed_.clear();
  io.MouseWheel = io.MouseWheelH = 0;
  while (!events_.empty()) {
    const InputEvent event = events_.front();
    events_.pop_front();
    if (apply(event, io)) break;
  }
  io.MousePos = {cursor_.x, cursor_.y};
  std::copy(std::begin(buttons_), std::end(buttons_), io.MouseDown);
}

bool InputQueue::apply(const InputEvent& event, ImGuiIO& io) {
  switch (event.kind) {
    case InputEvent::Kind::move:
      cursor_ = event.at;
      return false;
    case InputEvent::Kind::scroll:
      io.MouseWheelH += event.at.x;
      io.MouseWheel += event.at.y;
      return false;
    case InputEvent::Kind::character:
      io.AddInputCharacter(static_cast<unsigned>(event.code));
      return false;
    case InputEvent::Kind::button:
      if (event.code >= 0 && event.code < 3) buttons_[event.code] = event.down;
      return true;
    case InputEvent::Kind::focus_lost:
      held_.release_all(event.time_s);
      std::fill(std::begin(buttons_), std::end(buttons_), false);
      std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
      io.KeyCtrl = io.KeyShift = io.KeyAlt = io.KeySuper = false;
      return true;
    case InputEvent::Kind::key:
      break;
  }
  if (event.code < 0 || event.code >= static_cast<int>(std::size(io.KeysDown))) return false;
  io.KeysDown[event.code] = event.down;
  const auto down = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
  io.KeyCtrl = down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
  io.KeyShift = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
  io.KeyAlt = down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
  io.KeySuper = down(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
  modifiers_ = event.modifiers;
  if (!event.down) {
    held_.release(event.code, event.time_s);
  } else if (!io.WantTextInput) {
    pressed_.push_back(event.code);
    held_.press(event.code, event.time_s);
  }
  return true;
}

}  // namespace nightcity::viewer
