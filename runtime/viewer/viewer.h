// The window on a scene: renders it, shows it, and lets mouse and keyboard change camera and
// settings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/render/governor.h"
#include "runtime/render/settings.h"
#include "runtime/viewer/city.h"
#include "runtime/viewer/picture_job.h"

namespace nightcity::viewer {

struct ViewOptions {
  std::vector<std::string> scenes;           // the first is shown; the panel offers the others
  LoadScene load;                            // reads scene and lights
  std::string camera;                        // preset or file: see find_camera
  gpu::Device::Options device;               // the window adds the extensions it needs
  std::uint32_t width = 1280, height = 720;  // of the window, pixels
  render::RenderSettings settings;
  // Shown left of a line, beside `settings`.
  std::optional<render::RenderSettings> compared;
  std::optional<float> ev100;  // not set: metered from the picture again and again
  // The picture has 1 / divisor of the window's pixels along each side; 0 = coarse while the view
  // moves, then finer until every pixel is there.
  int divisor = 0;
  render::GovernorOptions governor;  // of frames while the view moves or the clock runs
  bool markers = false;
  bool play = false;                // start with the clock running
  double time_step_s = 0;           // by which the clock moves on a picture; 0: it keeps real time
  std::uint32_t max_frames = 4096;  // in the mean; then only changes are rendered
  bool offscreen = false;           // the window stays black, and is drawn into memory
  std::uint32_t quit_after = 0;     // frames shown; 0 = when the user closes the window
  std::string screenshot;           // PNG of the window with its panel, at the end; "" = none
  std::string save_camera;          // JSON of the camera at the end; "" = none
  PictureQuality picture;           // of saved pictures and of films
  // The first words of `nightview record` with what the window does not change: the device, the
  // parts of the model, the sky map.
  std::vector<std::string> record_command;
  std::filesystem::path edits;           // of lights, that went over the scene's; "" = none
  std::filesystem::path picture_folder;  // of saved pictures; "": see find_picture_folder
  std::filesystem::path
      settings_file;  // that Ctrl+S writes; "": settings.toml in the user's folder
  float font_px = 0;  // height of text; 0 = as the screen's scale asks for
};

/// Says what the window showed.
struct ViewReport {
  std::uint32_t shown = 0;   // frames shown
  std::uint32_t frames = 0;  // in the last mean
  std::string estimator;
  std::string pace;        // how frames kept to their budget; "" without one
  std::string intervals;   // between pictures in motion (FrameIntervals); "" without one
  int closing_signal = 0;  // that closed the window; 0 = none
};

/// Runs the window and returns when it is closed, by its user or a signal. Throws Error when there
/// is no display, the device cannot present, the scene cannot be loaded, or the validation layer
/// found a fault.
ViewReport run_viewer(const ViewOptions& options);

}  // namespace nightcity::viewer
