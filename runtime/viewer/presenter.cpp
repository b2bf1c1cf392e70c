#include "runtime/viewer/presenter.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace nightcity::viewer {
namespace {

gpu::Device::Options for_window(gpu::Device::Options options, const Window& window) {
  options.instance_extensions = window.instance_extensions();
  options.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return options;
}

float find_font_px(float wanted_px, const Window& window) {
  constexpr float standard_px = 13;
  return wanted_px > 0 ? wanted_px : standard_px * window.content_scale();
}

// A black picture stands for one while there is none. Mesa's CPU driver makes other code where a
// side is a power of two; the first picture, whose sides seldom are, would wait for its own.
constexpr glm::uvec2 black_size(3);

// The overlay's pipeline is made for the swapchain's images.
Swapchain& resized(Swapchain& swapchain, glm::uvec2 size) {
  swapchain.resize(size);
  return swapchain;
}

}  // namespace

Presenter::Presenter(std::uint32_t width, std::uint32_t height, gpu::Device::Options device,
                     float font_px, bool offscreen)
    : window_(width, height, "nightview"),
      device_(for_window(std::move(device), window_)),
      swapchain_(device_, offscreen ? VK_NULL_HANDLE : window_.create_surface(device_.instance())),
      screen_(device_),
      black_(device_, std::size_t{4} * black_size.x * black_size.y),
      overlay_(device_, window_, resized(swapchain_, window_.size()),
               find_font_px(font_px, window_)) {
  black_.fill_zero();
}

void Presenter::fit() {
  const glm::uvec2 size = window_.size();
  if (size != swapchain_.size() || outdated_) swapchain_.resize(size);
  outdated_ = false;
}

bool Presenter::show(const Shown& shown, measure::Image8* grab) {
  if (!swapchain_.acquire()) {
    outdated_ = true;
    return false;
  }
  const auto overlay = [this](VkCommandBuffer commands) { overlay_.record(commands); };
  std::vector<ShownPicture> pictures;
  const auto add = [&](const render::Renderer* renderer, float width) {
    if (!renderer) return;
    pictures.push_back({&renderer->display(), {renderer->width(), renderer->height()}, width});
  };
  add(shown.picture, 1);
  add(shown.left, shown.line);
  if (!shown.picture) pictures.insert(pictures.begin(), {&black_, black_size});
  outdated_ = !screen_.show(swapchain_, pictures, overlay, grab);
  return true;
}

}  // namespace nightcity::viewer
