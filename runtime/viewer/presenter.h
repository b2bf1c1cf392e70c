// The window with the device that draws into it: pictures, and Dear ImGui's panels over them.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/device.h"
#include "runtime/measure/image.h"
#include "runtime/render/renderer.h"
#include "runtime/viewer/overlay.h"
#include "runtime/viewer/screen.h"
#include "runtime/viewer/swapchain.h"
#include "runtime/viewer/window.h"

namespace nightcity::viewer {

class Presenter {
 public:
  /// Opens a window of `width` x `height` pixels. `font_px`: height of text; 0 = as the screen's
  /// scale asks for. `offscreen`: the window stays black. Throws Error without a display, or when
  /// the device cannot present.
  Presenter(std::uint32_t width, std::uint32_t height, gpu::Device::Options device, float font_px,
            bool offscreen);

  Window& window() { return window_; }
  const Window& window() const { return window_; }
  gpu::Device& device() { return device_; }
  const gpu::Device& device() const { return device_; }
  Overlay& overlay() { return overlay_; }
  /// Returns whether the window changed while it was shown, so that it needs show() again.
  bool is_outdated() const { return outdated_; }

  /// Makes the images fit the window, where they do not.
  void fit();
  /// The renderers whose pictures are shown; null where there is none.
  struct Shown {
    const render::Renderer* picture = nullptr;
    const render::Renderer* left = nullptr;  // over the left part of the picture
    float line = 0;                          // the end of that part, as a share of the width
  };
  /// Shows pictures, or black without one, and what was drawn since Overlay::begin(). Stores what
  /// the window then shows in `grab`, unless that is null. Returns whether it was shown: not while
  /// the window changes.
  bool show(const Shown& shown, measure::Image8* grab = nullptr);

 private:
  Window window_;
  gpu::Device device_;
  Swapchain swapchain_;
  Screen screen_;
  gpu::Buffer black_;  // a picture shown before the first
  Overlay overlay_;
  bool outdated_ = false;  // the swapchain no longer fits the window
};

}  // namespace nightcity::viewer
