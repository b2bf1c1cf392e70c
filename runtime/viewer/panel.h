// The panel over the picture: what the user may change, and what the renderer reports.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/timer.h"
#include "runtime/render/settings.h"
#include "runtime/scene/camera.h"
#include "runtime/viewer/controls.h"

struct ImDrawList;

namespace nightcity::viewer {

/// The state of the window, which the panel, the mouse and the keys change.
struct ViewerState {
  render::RenderSettings settings;
  CameraControl camera;
  bool accumulate = true;  // else each frame stands alone
  bool auto_exposure = true;
  bool markers = false;
  bool play = false;           // the clock runs
  float clock_speed = 1;       // seconds of the night per second
  bool night_changes = false;  // the scene has schedules or traffic, so that the clock matters
  // 1, 2, 4 or 8: the picture has 1 / divisor of the window's pixels along each side. 0 = coarse
  // while the view moves, then finer and finer.
  int divisor = 0;
  bool show_panel = true;
  bool show_help = false;
};

/// The figures that the panel reports of the scene and the last frame.
struct FrameStats {
  std::string scene, device;
  std::size_t triangles = 0, lights = 0;
  bool has_light = true;                // lights or traffic; else the panel offers sky and moon
  std::vector<std::string> licences;    // of the data
  std::vector<std::string> cities;      // that can be opened
  std::uint32_t width = 0, height = 0;  // of the rendered picture
  std::uint32_t divisor = 1;            // of the window's sides, that the picture has
  std::uint32_t frames = 0;             // in the mean
  // The settings of the picture on the screen, where the next one is still being rendered.
  std::optional<render::RenderSettings> made_with;
  double frame_ms = 0;                  // of the device
  std::string work;                     // what goes on: "rendering every 2nd pixel, 40 %"
  std::string place;                    // where the camera is, in words
  std::span<const gpu::Timer::Span> passes;
};

/// The requests that the user made in the panel.
struct PanelRequests {
  std::string camera_preset;  // a name of camera_presets(), or ""
  bool save = false;          // the picture, as PNG and EXR
  std::string open;           // one of the cities, or ""
};

/// Draws the panel into the current ImGui frame. It stays on the screen.
PanelRequests draw_panel(ViewerState& state, const FrameStats& stats);

/// Converts seconds since noon to "23:05".
std::string clock_text(double time_s);

/// Returns "paper, 32 candidates, 5 neighbours, mean of 64 frames": the window shows it with and
/// without the panel.
std::string caption(const ViewerState& state, const FrameStats& stats);

}  // namespace nightcity::viewer
