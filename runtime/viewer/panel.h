// The panel over the picture: what the user may change, and what the renderer says.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/timer.h"
#include "runtime/render/settings.h"
#include "runtime/scene/camera.h"

struct ImDrawList;

namespace nightcity {

/// What the window shows; changed by panel, mouse and keys.
struct ViewerState {
  RenderSettings settings;
  CameraPose pose;
  bool fly = false;        // else orbit
  float speed_m_s = 10;    // of flying
  bool accumulate = true;  // else each frame stands alone
  bool auto_exposure = true;
  bool markers = false;
  bool play = false;           // the clock runs
  float clock_speed = 1;       // seconds of the night a second
  bool night_changes = false;  // the scene has schedules or traffic, so that the clock matters
  int divisor =
      0;  // 1, 2, 4 or 8: the picture has 1 / divisor of the window's pixels along each side; 0 = found out
  bool show_panel = true;
};

/// What the panel reports.
struct ViewerFigures {
  std::string scene, device;
  std::size_t triangles = 0, lights = 0;
  std::uint32_t width = 0, height = 0;  // of the rendered picture
  std::uint32_t frames = 0;             // in the mean
  double frame_ms = 0;                  // wall clock, rendering and showing
  std::span<const gpu::Timer::Span> passes;
};

/// What the user asked for with the last panel.
struct PanelRequests {
  bool restart = false;       // something changed the picture: it is to be rendered again
  std::string camera_preset;  // a name of camera_presets(), or ""
  bool save = false;          // the picture, as PNG and EXR
};

/// Draws the panel into the current ImGui frame.
PanelRequests draw_panel(ViewerState& state, const ViewerFigures& figures);

/// "23:05", of seconds since noon.
std::string clock_text(double time_s);

/// "paper, 32 candidates, 5 neighbours, mean of 64 frames": stands in the window whether or not the panel is
/// shown.
std::string caption(const ViewerState& state, const ViewerFigures& figures);

}  // namespace nightcity
