// A window and its mouse and keyboard input. Only window.cpp, overlay.cpp and viewer.cpp include
// GLFW.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

struct GLFWwindow;

namespace nightcity::viewer {

/// Mouse and keyboard input since the last poll. The caller must ignore it while the panel uses
/// mouse or keyboard.
struct InputState {
  glm::vec2 drag{0};         // pixels, left button
  glm::vec2 pan{0};          // pixels, right or middle button
  float scroll = 0;          // notches, positive away from the user
  glm::vec3 fly{0};          // right, up, forward: -1, 0 or 1, from the keys D/A, E/Q, W/S
  bool fast = false;         // Shift is held
  std::vector<int> pressed;  // keys that went down, as GLFW_KEY_*
};

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

  /// Handles events and returns the input. With `wait_s` > 0, sleeps until an event arrives or the
  /// time is over.
  InputState poll(double wait_s);
  bool closing() const;
  /// Returns the size of the drawable area in pixels, 0 while minimised.
  glm::uvec2 size() const;
  void set_title(const std::string& title);
  GLFWwindow* handle() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
  glm::dvec2 cursor_{0};
  bool dragging_ = false, panning_ = false;
  InputState events_;  // filled by callbacks until poll() returns it
};

}  // namespace nightcity::viewer
