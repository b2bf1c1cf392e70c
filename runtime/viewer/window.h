// A window and what hands do in it. GLFW stays inside window.cpp and overlay.cpp.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

struct GLFWwindow;

namespace nightcity {

/// Hands since the last poll. Nothing while the panel has the mouse or the keyboard: the caller asks it.
struct Hands {
  glm::vec2 drag{0};         // pixels, left button
  glm::vec2 pan{0};          // pixels, right or middle button
  float scroll = 0;          // notches, away from the user positive
  glm::vec3 fly{0};          // right, up, forward: -1, 0 or 1 of the keys D/A, E/Q, W/S held
  bool fast = false;         // Shift
  std::vector<int> pressed;  // keys that went down, as GLFW_KEY_*
};

/// One window; the process may have one at a time. Throws Error without a display.
class Window {
 public:
  Window(std::uint32_t width, std::uint32_t height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Instance extensions that a surface needs.
  std::vector<const char*> instance_extensions() const;
  /// The caller destroys it before the instance.
  VkSurfaceKHR create_surface(VkInstance instance) const;

  /// Handles events; with `wait_s` > 0 sleeps until one comes or the time is over.
  Hands poll(double wait_s);
  bool closing() const;
  /// Of the drawable area, in pixels; 0 while minimised.
  glm::uvec2 size() const;
  void set_title(const std::string& title);
  GLFWwindow* handle() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
  glm::dvec2 cursor_{0};
  bool dragging_ = false, panning_ = false;
  Hands events_;  // filled by callbacks until poll() takes it
};

}  // namespace nightcity
