// Keeps what the user of the window has done so far, and obeys keys: nothing here needs a window.
#pragma once

#include <filesystem>
#include <vector>

#include "runtime/viewer/keys.h"
#include "runtime/viewer/notices.h"
#include "runtime/viewer/panel.h"
#include "runtime/viewer/pick.h"

namespace nightcity::viewer {

/// A key's requests to the window itself.
struct WindowRequests {
  bool close = false, save_picture = false, cancel_picture = false, fullscreen = false;
  bool copy_camera = false, paste_camera = false, compare = false;
  bool switch_light = false, save_edits = false, record_path = false, save_settings = false;
  bool film = false, stop_film = false;
  double brighten = 1;  // factor for the light that was clicked
  int larger_text = 0;  // steps, negative for smaller
  int next_city = 0;    // steps in the list of cities
};

/// This goes on in the background, and Esc stops it.
enum class Background { nothing, picture, film };

class Session {
 public:
  ViewerState state;
  Notices notices;
  std::optional<Pick> picked;
  std::optional<glm::vec3> measured_from;  // where distances to `picked` begin

  /// Shows another city: forgets moves, and reads the bookmarks in `bookmarks`, a file that need
  /// not exist.
  void open(const scene::CameraPose& pose, const std::filesystem::path& bookmarks, double now_s);

  /// Does what a key asks for. `scene`: null while the first is being opened; keys that need one
  /// are then answered with a line.
  WindowRequests press(const KeyPress& key, const scene::RenderScene* scene, Background background,
                       double now_s);
  /// Shows a view from now on. The difference to the reference ends a comparison.
  void show(const ViewKind& view, double now_s);
  /// Moves the camera as hands do.
  void move(const Hands& hands, const scene::RenderScene& scene, const glm::vec2& window,
            double now_s);
  /// Goes to a pose at once.
  void go_to(const scene::CameraPose& pose, double now_s);
  /// Goes to the pose that text holds (scene::to_text), or says that it holds none.
  void paste_camera(const std::string& text, double now_s);
  /// Begins to compare the picture with itself, or ends it. A comparison ends the view of the
  /// difference to the reference.
  void toggle_comparison();
  /// Exchanges the side of the comparison that the panel changes with the other.
  void change_side();
  /// Moves the clock on by real seconds, or by a fixed step of the night.
  void run_clock(double elapsed_s, double step_s, double now_s);
  /// Returns whether it does. It stands while pictures of two times, or kinds of light, are
  /// compared: lights would be switched to and fro. It stands, too, while a picture is compared
  /// with its reference: both are to be of one time.
  bool clock_runs() const {
    return state.play && state.night_changes && state.settings.display.view != VIEW_DIFFERENCE &&
           (!state.compare.on || have_same_lights(state.settings, state.compare.other));
  }

  std::size_t count_bookmarks() const { return bookmarks_.size(); }
  const std::filesystem::path& bookmark_file() const { return bookmark_file_; }
  /// Returns whether a move can be taken back.
  bool can_undo() const { return !undo_.empty(); }

 private:
  void remember(double now_s);
  void add_bookmark(double now_s);
  void take_back(double now_s);
  void measure(double now_s);
  void change_motion(const scene::RenderScene& scene, double now_s);
  void close_or_stop(Background background, WindowRequests& requests);

  std::vector<scene::CameraPose> undo_, bookmarks_;
  std::filesystem::path bookmark_file_;
  double moved_at_s_ = -1e9;
};

}  // namespace nightcity::viewer
