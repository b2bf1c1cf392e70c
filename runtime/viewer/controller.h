// Obeys the user: from keys, mouse and panel to what session, window and workbench do.
#pragma once

#include <memory>
#include <string>

#include "runtime/viewer/film_desk.h"
#include "runtime/viewer/gamepad.h"
#include "runtime/viewer/light_desk.h"
#include "runtime/viewer/picture_desk.h"
#include "runtime/viewer/presenter.h"
#include "runtime/viewer/session.h"
#include "runtime/viewer/viewer.h"
#include "runtime/viewer/workbench.h"

namespace nightcity::viewer {

class Controller {
 public:
  /// All must outlive the object.
  Controller(const ViewOptions& options, Presenter& presenter, Workbench& workbench);

  /// Returns an opening of a scene, for Workbench::open.
  static std::unique_ptr<Opening> start_opening(const ViewOptions& options,
                                                const std::string& path);

  /// Sets the time of what is done and said from now on, s of the window's clock.
  void set_now(double now_s) { now_s_ = now_s; }
  /// Shows a city that is open, if one is. Returns whether it did. Throws Error where it cannot be
  /// opened and no other is shown.
  bool finish_opening();
  /// Opens the scene in the background, and offers it in the panel from now on.
  void open(const std::string& path);
  // Opens the city that is `steps` further in the list, which goes round.
  void open_next(int steps);
  /// Hands the panel the next events, draws it, and does what was asked for.
  void draw();
  /// Writes the picture that Workbench::Result::saved spoke of, and says where it is, or why not.
  void finish_saving() { pictures_.finish(now_s_); }
  /// Looks how far a film is. Returns whether it has ended, of which there is news to show then.
  bool look_at_film() { return films_.look(now_s_); }
  bool films() const { return films_.films(); }

  /// Returns what the pictures are to show.
  Views views() const;
  /// Returns how long the view has not moved, s.
  double still_s() const { return now_s_ - moved_s_; }
  Session& session() { return session_; }
  FrameStats& stats() { return stats_; }
  /// Returns whether there is a gamepad, which sends no events, and whether it is being moved.
  bool has_gamepad() const { return pad_.has_value(); }
  bool is_pad_moved() const { return pad_ && Gamepad::is_moved(*pad_); }
  /// Looks at the gamepad. Call it before draw().
  void look_at_gamepad() { pad_ = read_gamepad(); }

 private:
  void draw_city(const glm::vec2& size);
  void draw_opening(const glm::vec2& size);
  void describe_work();
  void look_at_pick();
  void handle_input(const glm::vec2& size);
  void handle_early_input();
  Background find_background() const;
  void obey(const WindowRequests& requests);
  void obey_for_window(const WindowRequests& requests);
  void obey(const PanelRequests& requests);
  void toggle_comparison();
  std::string go_to_place(const std::string& text);
  void film();
  void save_settings();

  const ViewOptions& options_;
  Presenter& presenter_;
  Window& window_;  // the presenter's
  Workbench& workbench_;
  Session session_;
  FrameStats stats_;
  LightDesk lights_;
  FilmDesk films_;
  PictureDesk pictures_;
  Gamepad gamepad_;
  std::optional<PadState> pad_;
  std::string place_text_;      // where the user asked to go last,
  std::size_t place_turn_ = 0;  // and how often in a row
  double pad_s_ = 0;            // when the gamepad last moved something
  double pick_cd_m2_ = 0;       // luminance where something was picked, when last looked at
  double now_s_ = 0, moved_s_ = -1e9;
};

}  // namespace nightcity::viewer
