#include "runtime/viewer/session.h"

#include <fmt/format.h>

#include "formats/error.h"
#include "runtime/scene/camera_path.h"
#include "runtime/viewer/camera_motion.h"
#include "runtime/viewer/light_editor.h"
#include "runtime/viewer/views.h"

namespace nightcity::viewer {
namespace {

// Motions with less than this between them are one move, which is taken back as a whole.
constexpr double one_move_s = 1;
constexpr std::size_t max_undo = 100;

}  // namespace

void Session::open(const scene::CameraPose& pose, const std::filesystem::path& bookmarks,
                   double now_s) {
  state.camera.pose = pose;
  state.camera.pivot.reset();
  picked.reset();
  measured_from.reset();
  undo_.clear();
  bookmarks_.clear();
  bookmark_file_ = bookmarks;
  std::error_code ignored;
  if (!std::filesystem::exists(bookmarks, ignored)) return;
  try {
    bookmarks_ = scene::read_poses(bookmarks, pose.origin);
    notices.say(fmt::format("{} bookmarks of {}", bookmarks_.size(), bookmarks.string()), now_s);
  } catch (const Error& error) {
    notices.say(error.what(), now_s, true);
  }
}

void Session::remember(double now_s) {
  if (now_s - moved_at_s_ > one_move_s) {
    undo_.push_back(state.camera.pose);
    if (undo_.size() > max_undo) undo_.erase(undo_.begin());
  }
  moved_at_s_ = now_s;
}

void Session::move(const Hands& hands, const scene::RenderScene& scene, const glm::vec2& window,
                   double now_s) {
  if (hands.clicked)
    picked = pick(scene, state.camera.pose, hands.cursor, window, state.settings.time_s,
                  state.settings.environment.lights);
  const CameraControl before = state.camera;
  move_camera(state.camera, hands, scene, window);
  if (is_same_pose(before.pose, state.camera.pose)) return;
  const CameraControl after = state.camera;
  state.camera = before;
  remember(now_s);
  state.camera = after;
}

void Session::go_to(const scene::CameraPose& pose, double now_s) {
  moved_at_s_ = -1e9;
  remember(now_s);
  moved_at_s_ = -1e9;
  state.camera.pose = pose;
  state.camera.pivot.reset();
}

void Session::take_back(double now_s) {
  if (undo_.empty()) {
    notices.say("no move to take back", now_s);
    return;
  }
  state.camera.pose = undo_.back();
  state.camera.pivot.reset();
  undo_.pop_back();
  moved_at_s_ = -1e9;
}

void Session::paste_camera(const std::string& text, double now_s) {
  try {
    go_to(scene::parse_camera(text, "clipboard", state.camera.pose.origin), now_s);
  } catch (const Error&) {
    notices.say("the clipboard holds no camera (Ctrl+C copies one)", now_s, true);
  }
}

void Session::add_bookmark(double now_s) {
  bookmarks_.push_back(state.camera.pose);
  try {
    scene::write_poses(bookmark_file_, bookmarks_);
    notices.say(fmt::format("bookmark {} set, in {}", bookmarks_.size(), bookmark_file_.string()),
                now_s);
  } catch (const Error& error) {
    notices.say(fmt::format("bookmark {} set, but not kept: {}", bookmarks_.size(), error.what()),
                now_s, true);
  }
}

void Session::measure(double now_s) {
  if (!picked) {
    notices.say("click the point from which to measure first", now_s);
    return;
  }
  measured_from = picked->point;
  notices.say("click the points to measure to; Esc ends it", now_s);
}

void Session::change_motion(const scene::RenderScene& scene, double now_s) {
  CameraControl& camera = state.camera;
  camera.motion = camera.motion == Motion::orbit ? Motion::fly
                  : camera.motion == Motion::fly ? Motion::walk
                                                 : Motion::orbit;
  const char* names[] = {"orbit", "fly", "walk"};
  notices.say(names[static_cast<int>(camera.motion)], now_s);
  if (camera.motion != Motion::walk) return;
  const scene::CameraPose before = camera.pose;
  begin_to_walk(camera, scene);
  const scene::CameraPose after = camera.pose;
  camera.pose = before;
  go_to(after, now_s);
}

void Session::close_or_stop(Background background, WindowRequests& requests) {
  if (state.show_help)
    state.show_help = false;
  else if (picked)
    picked.reset();
  else if (measured_from)
    measured_from.reset();
  else if (background == Background::picture)
    requests.cancel_picture = true;
  else if (background == Background::film)
    requests.stop_film = true;
  else
    requests.close = true;
}

void Session::show(const ViewKind& view, double now_s) {
  show_view(view, state.settings.display);
  if (view.view != VIEW_DIFFERENCE) return;
  if (state.compare.on)
    notices.say("A | B ends: the picture is compared with its reference", now_s);
  state.compare.on = false;
}

WindowRequests Session::press(const KeyPress& key, const scene::RenderScene* scene,
                              Background background, double now_s) {
  WindowRequests requests;
  if (const char* keys = find_keys_for_scene(key.action); keys && !scene) {
    notices.say(fmt::format("{}: wait, the scene is still being opened", keys), now_s);
    return requests;
  }
  switch (key.action) {
    case Action::move:
      break;
    case Action::estimator:
      if (const auto& all = render::list_estimators();
          key.number >= 1 && key.number <= static_cast<int>(all.size()))
        state.settings.sampling.estimator = all[static_cast<std::size_t>(key.number - 1)].estimator;
      break;
    case Action::markers:
      state.markers = !state.markers;
      break;
    case Action::next_motion:
      change_motion(*scene, now_s);
      break;
    case Action::next_view: {
      const auto& views = list_views();
      show(views[(state.settings.display.view + 1) % views.size()], now_s);
      break;
    }
    case Action::go_to_place:
      state.show_panel = true;
      state.focus_place = 2;
      break;
    case Action::record_path:
      requests.record_path = true;
      break;
    case Action::film:
      requests.film = true;
      break;
    case Action::switch_light:
      requests.switch_light = true;
      break;
    case Action::dim_light:
      requests.brighten = 1 / dim_step;
      break;
    case Action::brighten_light:
      requests.brighten = dim_step;
      break;
    case Action::save_edits:
      requests.save_edits = true;
      break;
    case Action::save_settings:
      requests.save_settings = true;
      break;
    case Action::measure:
      measure(now_s);
      break;
    case Action::compare:
      requests.compare = true;
      break;
    case Action::save_picture:
      requests.save_picture = true;
      break;
    case Action::play:
      state.play = !state.play;
      if (scene && !state.night_changes)
        notices.say("nothing in this scene changes with time", now_s);
      break;
    case Action::panel:
      state.show_panel = !state.show_panel;
      break;
    case Action::help:
      state.show_help = !state.show_help;
      break;
    case Action::close:
      close_or_stop(background, requests);
      break;
    case Action::undo_move:
      take_back(now_s);
      break;
    case Action::copy_camera:
      requests.copy_camera = true;
      break;
    case Action::paste_camera:
      requests.paste_camera = true;
      break;
    case Action::bookmark:
      add_bookmark(now_s);
      break;
    case Action::go_to_bookmark:
      if (key.number >= 1 && key.number <= static_cast<int>(bookmarks_.size()))
        go_to(bookmarks_[static_cast<std::size_t>(key.number - 1)], now_s);
      else
        notices.say(fmt::format("there is no bookmark {}: B sets one", key.number), now_s);
      break;
    case Action::fullscreen:
      requests.fullscreen = true;
      break;
    case Action::next_city:
      requests.next_city = 1;
      break;
    case Action::previous_city:
      requests.next_city = -1;
      break;
    case Action::larger_text:
      requests.larger_text = 1;
      break;
    case Action::smaller_text:
      requests.larger_text = -1;
      break;
  }
  return requests;
}

void Session::toggle_comparison() {
  state.compare.on = !state.compare.on;
  state.compare.changes_b = true;
  state.compare.other = state.settings;
  render::DisplaySettings& display = state.settings.display;
  if (state.compare.on && display.view == VIEW_DIFFERENCE) display.view = VIEW_PICTURE;
}

void Session::change_side() {
  const render::DisplaySettings display = state.settings.display;
  std::swap(state.settings, state.compare.other);
  // Both sides are shown alike, but for the filter.
  const bool denoise = state.settings.display.denoise;
  state.settings.display = display;
  state.settings.display.denoise = denoise;
  state.compare.changes_b = !state.compare.changes_b;
}

void Session::run_clock(double elapsed_s, double step_s, double now_s) {
  if (!clock_runs()) return;
  double time_s = state.settings.time_s;
  time_s += step_s > 0 ? step_s : elapsed_s * double(state.clock_speed);
  if (time_s > night_end_s || time_s < night_begin_s) {
    time_s = night_begin_s;
    notices.say("the night is over: it begins again", now_s);
  }
  state.settings.time_s = state.compare.other.time_s = time_s;  // both sides have one clock
}

}  // namespace nightcity::viewer
