#include "runtime/viewer/window.h"

// GLFW with Vulkan's types: vulkan.h comes first, so that it declares surface creation.
#include <GLFW/glfw3.h>

#include <algorithm>
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
  watch_input();
}

// Input comes by events, not by polling its state: on a slow device a whole drag may fall between
// two frames.
void Window::watch_input() {
  using Kind = InputEvent::Kind;
  static const auto push = [](GLFWwindow* window, InputEvent event) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    event.time_s = now_s();
    self.queue_.push(event);
    self.news_ = true;
  };
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    push(window, {.kind = Kind::move, .at = {float(x), float(y)}});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    push(window, {.kind = Kind::button, .code = button, .down = action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
    push(window, {.kind = Kind::scroll, .at = {float(x), float(y)}});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action == GLFW_REPEAT) return;  // the panel repeats keys itself
    push(window,
         {.kind = Kind::key, .code = key, .down = action == GLFW_PRESS, .modifiers = modifiers});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    push(window, {.kind = Kind::character, .code = static_cast<int>(character)});
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
    if (!focused) push(window, {.kind = Kind::focus_lost});
  });
  const auto refresh = [](GLFWwindow* window) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->news_ = true;
  };
  glfwSetWindowRefreshCallback(window_, refresh);
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    self.dropped_.insert(self.dropped_.end(), paths, paths + count);
    self.news_ = true;
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

void Window::poll(double wait_s) {
  if (wait_s > 0) {
    glfwWaitEventsTimeout(wait_s);
  } else {
    glfwPollEvents();
  }
}

bool Window::take_news() {
  return std::exchange(news_, false);
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(dropped_, {});
}

double Window::now_s() {
  return glfwGetTime();
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_);
}

glm::uvec2 Window::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {width, height};
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::hide() {
  glfwHideWindow(window_);
  glfwPollEvents();
}

bool Window::is_minimised() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0;
}

float Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(std::max(x, y), 1.0f, 4.0f);
}

// A title that is set again is an event of the window's own, which would wake it from its sleep.
void Window::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::toggle_fullscreen() {
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, windowed_.x, windowed_.y, windowed_.z, windowed_.w, 0);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &windowed_.x, &windowed_.y);
  glfwGetWindowSize(window_, &windowed_.z, &windowed_.w);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

}  // namespace nightcity::viewer
