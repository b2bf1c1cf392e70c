// The window on a scene: renders, shows, and lets hands change camera and settings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/gpu/device.h"
#include "runtime/render/settings.h"
#include "runtime/scene/render_scene.h"

namespace nightcity {

struct ViewOptions {
  std::string scene;                         // name of its file, to be shown
  std::string camera;                        // preset or file, as find_camera has it
  gpu::Device::Options device;               // the window adds the extensions that it needs
  std::uint32_t width = 1280, height = 720;  // of the window, pixels
  RenderSettings settings;
  std::optional<float> ev100;  // left out: metered from the picture as it goes
  int divisor =
      0;  // the picture has 1 / divisor of the window's pixels along each side; 0 = as many as
          // still answer hands at once
  bool markers = false;
  bool play = false;                // start with the clock running
  std::uint32_t max_frames = 4096;  // in the mean; then only changes are rendered
  std::uint32_t quit_after = 0;     // frames shown; 0 = when the user closes the window
  std::string screenshot;           // PNG of the window, panel and all, at the end; "" = none
  std::string save_camera;          // JSON of the camera at the end; "" = none
};

/// What the window showed last.
struct ViewReport {
  std::uint32_t shown = 0;   // frames
  std::uint32_t frames = 0;  // in the last mean
  std::string estimator;
};

/// Returns when the window is closed. Throws Error: no display, a device that cannot present,
/// validation messages.
ViewReport run_viewer(RenderScene scene, const ViewOptions& options);

}  // namespace nightcity
