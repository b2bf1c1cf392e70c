#include "runtime/viewer/window.h"

// GLFW with Vulkan's types: vulkan.h comes first, so that it declares surface creation.
#include <GLFW/glfw3.h>

#include <utility>

#include "formats/error.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::viewer {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  return glfwGetError(&text) != GLFW_NO_ERROR && text ? text : "no reason given";
}

Error no_window(const std::string& what) {
  return Error("window", what + ": " + last_glfw_error() + " (nightview render needs no window)");
}

}  // namespace

Window::Window(std::uint32_t width, std::uint32_t height, const std::string& title) {
  if (!glfwInit()) throw no_window("no display");
  try {
    if (!glfwVulkanSupported()) throw no_window("the window system has no Vulkan");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(),
                               nullptr, nullptr);
    if (!window_) throw no_window("it cannot be opened");
  } catch (...) {
    glfwTerminate();
    throw;
  }
  glfwSetWindowUserPointer(window_, this);
  glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);
  // Input comes by events, not by polling its state: on a slow device a whole drag may fall between
  // two frames.
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    (button == GLFW_MOUSE_BUTTON_LEFT ? self.dragging_ : self.panning_) = action == GLFW_PRESS;
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    const glm::vec2 step(glm::dvec2(x, y) - self.cursor_);
    self.cursor_ = {x, y};
    if (self.dragging_) self.events_.drag += step;
    if (self.panning_) self.events_.pan += step;
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->events_.scroll +=
        static_cast<float>(notches);
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS)
      static_cast<Window*>(glfwGetWindowUserPointer(window))->events_.pressed.push_back(key);
  });
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

std::vector<const char*> Window::instance_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (!names) throw no_window("the window system has no Vulkan");
  return {names, names + count};
}

VkSurfaceKHR Window::create_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  VK_CHECK(glfwCreateWindowSurface(instance, window_, nullptr, &surface));
  return surface;
}

InputState Window::poll(double wait_s) {
  if (wait_s > 0) {
    glfwWaitEventsTimeout(wait_s);
  } else {
    glfwPollEvents();
  }
  InputState input = std::exchange(events_, {});

  const auto held = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0f : 0.0f; };
  input.fly = {held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_E) - held(GLFW_KEY_Q),
               held(GLFW_KEY_W) - held(GLFW_KEY_S)};
  input.fast = held(GLFW_KEY_LEFT_SHIFT) + held(GLFW_KEY_RIGHT_SHIFT) > 0;
  return input;
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_);
}

glm::uvec2 Window::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {width, height};
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

}  // namespace nightcity::viewer
