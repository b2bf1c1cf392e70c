// The panel over the picture: what the user may change, and what the renderer reports.
#pragma once

#include <array>
#include <string>

#include "runtime/render/governor.h"
#include "runtime/render/settings.h"
#include "runtime/scene/camera.h"
#include "runtime/viewer/comparison.h"
#include "runtime/viewer/controls.h"
#include "runtime/viewer/frame_stats.h"
#include "runtime/viewer/views.h"

struct ImDrawList;

namespace nightcity::viewer {

/// The film that is recorded of a path.
struct FilmSettings {
  float duration_s = 10;  // from the path's beginning to its end; R sets it to what the path took
  float pictures_per_s = 25;
};

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
  render::GovernorOptions governor;       // of frames while the view moves
  float budget_ms = 0, target_error = 0;  // what the panel's sliders stand at
  Comparison compare;
  FilmSettings film;
  std::array<char, 200> place{};  // typed: where to go
  int focus_place = 0;            // frames for which the keyboard goes to that box
  bool show_panel = true;
  bool show_help = false;
};

/// The requests that the user made in the panel.
struct PanelRequests {
  std::string camera_preset;  // a name of camera_presets(), or ""
  bool save = false;          // the picture, as PNG and EXR
  std::string open;           // one of the cities, or ""
  std::string go_to;          // a place, or ""
  std::string preset;         // of settings, or ""
  bool save_settings = false;
  bool compare = false;      // begin or end to compare two pictures
  bool change_side = false;  // of the comparison, that the panel changes
  const ViewKind* show = nullptr;
  bool film = false, stop_film = false;
};

/// Draws the panel into the current ImGui frame. It stays on the screen. While a first scene is
/// opened (FrameStats::scene is empty), what needs one is greyed.
PanelRequests draw_panel(ViewerState& state, const FrameStats& stats);

/// Converts seconds since noon to "23:05".
std::string clock_text(double time_s);

/// Returns "paper, 32 candidates, 5 neighbours, mean of 64 frames": the window shows it with and
/// without the panel.
std::string caption(const ViewerState& state, const FrameStats& stats);

}  // namespace nightcity::viewer
