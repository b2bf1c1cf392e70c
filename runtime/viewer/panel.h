// The panel over the picture: what the user may change, and what the renderer reports.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/timer.h"
#include "runtime/render/settings.h"
#include "runtime/scene/camera.h"

struct ImDrawList;

namespace nightcity::viewer {

/// The state of the window, which the panel, the mouse and the keys change.
struct ViewerState {
  render::RenderSettings settings;
  scene::CameraPose pose;
  bool fly = false;        // else the camera orbits
  float speed_m_s = 10;    // when flying
  bool accumulate = true;  // else each frame stands alone
  bool auto_exposure = true;
  bool markers = false;
  bool play = false;           // the clock runs
  float clock_speed = 1;       // seconds of the night per second
  bool night_changes = false;  // the scene has schedules or traffic, so that the clock matters
  // 1, 2, 4 or 8: the picture has 1 / divisor of the window's pixels along each side. 0 = chosen by
  // the device's speed.
  int divisor = 0;
  bool show_panel = true;
};

/// The figures that the panel reports of the scene and the last frame.
struct FrameStats {
  std::string scene, device;
  std::size_t triangles = 0, lights = 0;
  std::uint32_t width = 0, height = 0;  // of the rendered picture
  std::uint32_t frames = 0;             // in the mean
  double frame_ms = 0;                  // wall clock, rendering and showing
  std::span<const gpu::Timer::Span> passes;
};

/// The requests that the user made in the panel.
struct PanelRequests {
  bool restart = false;       // something changed the picture, which must be rendered again
  std::string camera_preset;  // a name of camera_presets(), or ""
  bool save = false;          // the picture, as PNG and EXR
};

/// Draws the panel into the current ImGui frame.
PanelRequests draw_panel(ViewerState& state, const FrameStats& stats);

/// Converts seconds since noon to "23:05".
std::string clock_text(double time_s);

/// Returns "paper, 32 candidates, 5 neighbours, mean of 64 frames": the window shows it with and
/// without the panel.
std::string caption(const ViewerState& state, const FrameStats& stats);

}  // namespace nightcity::viewer
