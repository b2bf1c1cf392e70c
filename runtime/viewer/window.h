// A window, and its mouse and keyboard input as a queue of events. Only window.cpp, overlay.cpp,
// keys.cpp and gamepad.cpp include GLFW.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "runtime/viewer/input_queue.h"

struct GLFWwindow;

namespace nightcity::viewer {

/// One window; the process may have one at a time. Throws Error without a display.
class Window {
 public:
  Window(std::uint32_t width, std::uint32_t height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Returns the instance extensions that a surface needs.
  std::vector<const char*> instance_extensions() const;
  /// Returns a surface that the caller must destroy before the instance.
  VkSurfaceKHR create_surface(VkInstance instance) const;

  /// Handles events, which go to queue(). With `wait_s` > 0, sleeps until an event arrives or the
  /// time is over.
  void poll(double wait_s);
  InputQueue& queue() { return queue_; }
  const InputQueue& queue() const { return queue_; }
  /// Returns whether the user did anything, or the window system asks for the window to be drawn
  /// anew, since the last call.
  bool take_news();
  /// Returns the files dropped on the window since the last call.
  std::vector<std::string> take_dropped();

  /// Returns the seconds of the clock that events carry.
  static double now_s();
  bool closing() const;
  void close();
  void hide();
  bool is_minimised() const;
  /// Returns the size of the drawable area in pixels, 0 while minimised.
  glm::uvec2 size() const;
  /// Returns how many pixels something needs that has one on an ordinary screen.
  float content_scale() const;
  void set_title(const std::string& title);
  /// Fills the screen that the window is on, or goes back to the size before.
  void toggle_fullscreen();
  std::string clipboard() const;
  void set_clipboard(const std::string& text);
  GLFWwindow* handle() const { return window_; }

 private:
  void watch_input();

  GLFWwindow* window_ = nullptr;
  InputQueue queue_;
  bool news_ = true;
  std::vector<std::string> dropped_;
  std::string title_;
  glm::ivec4 windowed_{0};  // place and size before the window filled the screen
};

}  // namespace nightcity::viewer
