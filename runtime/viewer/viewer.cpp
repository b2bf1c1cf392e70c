#include "runtime/viewer/viewer.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "formats/error.h"
#include "runtime/measure/png.h"
#include "runtime/viewer/closing_signals.h"
#include "runtime/viewer/config_folder.h"
#include "runtime/viewer/controller.h"
#include "runtime/viewer/frame_intervals.h"
#include "runtime/viewer/metering.h"
#include "runtime/viewer/presenter.h"
#include "runtime/viewer/workbench.h"

namespace nightcity::viewer {
namespace {

// The longest that the loop waits for the device before it looks at the input again.
constexpr double wait_s = 0.004;
// The panel waits so long for a slice of the device before it is drawn without being shown.
constexpr double alive_s = 0.05;
// The line about what goes on is written anew so often.
constexpr double report_s = 0.25;
// Pictures are metered so far apart: each takes as long as a part of a frame on a GPU.
constexpr double meter_s = 0.1;
// A sleeping window looks for a signal so often.
constexpr double sleep_s = 0.1;

// Returns the file that keeps the places of panels, "" without a home.
std::filesystem::path find_places_file() {
  const std::filesystem::path folder = find_config_folder();
  return folder.empty() ? folder : folder / "window.ini";
}

class Viewer {
 public:
  explicit Viewer(const ViewOptions& options)
      : options_(options),
        first_(Controller::start_opening(options_, options_.scenes.front())),
        presenter_(options.width, options.height, options.device, options.font_px,
                   options.offscreen),
        window_(presenter_.window()),
        workbench_(presenter_.device()),
        controller_(options_, presenter_, workbench_),
        session_(controller_.session()),
        stats_(controller_.stats()) {
    workbench_.open(std::move(first_));
    if (const auto places = find_places_file(); !places.empty())
      presenter_.overlay().load_places(places);
  }

  ViewReport run() {
    const ClosingSignals signals;
    while (!window_.closing() && ClosingSignals::first() == 0 &&
           (options_.quit_after == 0 || shown_ < options_.quit_after))
      step();
    window_.hide();
    workbench_.stop();
    keep_places();
    if (!options_.save_camera.empty())
      scene::write_camera(options_.save_camera, session_.state.camera.pose);
    presenter_.device().check_validation();
    return {shown_,
            stats_.frames,
            render::name_of(session_.state.settings.sampling.estimator),
            stats_.pace,
            intervals_.describe(),
            ClosingSignals::first()};
  }

 private:
  // A home that takes no files is no reason to fail.
  void keep_places() {
    const std::filesystem::path places = find_places_file();
    if (places.empty()) return;
    try {
      presenter_.overlay().save_places(places);
    } catch (const Error& error) {
      spdlog::debug("{}", error.what());
    }
  }

  void step() {
    const bool pictured = work();
    window_.poll(find_sleep_s());
    now_s_ = Window::now_s();
    if (window_.is_minimised()) {
      minimised_ = true;
      last_step_s_ = now_s_;
      return;
    }
    controller_.set_now(now_s_);
    if (controller_.finish_opening()) {
      metering_.restart();
      metered_s_ = -meter_s;
      // Once: what draws the panel keeps the first picture waiting, which draws it again.
      redraws_ = 1;
      reported_s_ = now_s_;
    }
    for (const std::string& path : window_.take_dropped()) controller_.open(path);
    const double elapsed_s = now_s_ - last_step_s_;
    last_step_s_ = now_s_;
    if (!workbench_.is_saving())  // lights have one time, which is that of the picture being saved
      run_clock(elapsed_s, pictured);
    // After news the panel is drawn a few times more: it settles within two frames.
    controller_.look_at_gamepad();
    if (window_.queue().held().any() || controller_.is_pad_moved())
      redraws_ = std::max(redraws_, 1);
    if (window_.take_news() || presenter_.is_outdated() || minimised_) redraws_ = 3;
    minimised_ = false;
    if (controller_.look_at_film()) redraws_ = 3;
    const bool reports =
        (works() || workbench_.opening() || controller_.films()) && now_s_ - reported_s_ > report_s;
    if (!pictured && redraws_ == 0 && !reports && !session_.notices.expire(now_s_) &&
        window_.queue().empty() && !adapt_exposure(elapsed_s))
      return;
    if (pictured) adapt_exposure(elapsed_s);
    new_picture_ |= pictured;
    draw();
  }

  // A clock that moves on by steps counts pictures: how many drafts come before the first depends on
  // how long shaders are being compiled.
  void run_clock(double elapsed_s, bool pictured) {
    const bool counts = pictured && !workbench_.picture()->is_draft();
    if (options_.time_step_s > 0)
      session_.run_clock(0, counts ? options_.time_step_s : 0, now_s_);
    else
      session_.run_clock(elapsed_s, 0, now_s_);
  }

  bool works() const { return workbench_.has_work(controller_.views(), now_s_); }

  double find_sleep_s() const {
    if (window_.is_minimised()) return sleep_s;
    if (workbench_.translates() || (workbench_.picture() && workbench_.picture()->compiles()))
      return 0.01;
    if (works() || !window_.queue().empty() || redraws_ > 0 || new_picture_) return 0;
    if (workbench_.opening() || controller_.has_gamepad()) return 0.02;
    return sleep_s;
  }

  // Works a slice at a picture. Returns whether the window has a new one to show.
  bool work() {
    if (!workbench_.has_city() || window_.is_minimised()) return false;
    // A picture that is ready is shown before the next slice is rendered.
    if (redraws_ > 0 || new_picture_ || !window_.queue().empty()) {
      if (!workbench_.wait(wait_s)) return false;
      if (!std::exchange(drawn_, false)) return false;
    }
    // A picture that is saved waits while the view moves, until the window shows where it went.
    const bool still = controller_.still_s() > Refinement::rest_s;
    switch (workbench_.work(controller_.views(), still, now_s_, wait_s)) {
      case Workbench::Result::nothing:
        return false;
      case Workbench::Result::saved:
        controller_.finish_saving();
        redraws_ = 3;
        return false;
      case Workbench::Result::picture:
        break;
    }
    describe_picture(*workbench_.picture(), stats_);
    is_metered_ = false;
    return true;
  }

  void meter(const LivePicture& picture) {
    is_metered_ = true;
    metered_s_ = now_s_;
    render::DisplaySettings& display = session_.state.settings.display;
    if (!session_.state.auto_exposure && !display.adapt_white) return;
    const Metered metered = picture.meter();
    if (session_.state.auto_exposure) metering_.set_target(metered.ev100);
    display.adapted_to =
        display.adapt_white ? follow_light(display.adapted_to, metered.light) : glm::vec3(0);
  }

  // Returns whether the exposure of the picture on the screen changed.
  bool adapt_exposure(double elapsed_s) {
    LivePicture* picture = workbench_.picture();
    if (!picture || picture->is_busy() || !picture->has_picture()) return false;
    if (!is_metered_ && now_s_ - metered_s_ >= meter_s) meter(*picture);
    ViewerState& state = session_.state;
    const bool begins = state.auto_exposure && !was_auto_;
    was_auto_ = state.auto_exposure;
    if (begins) metering_.restart();
    const bool adapts = state.settings.display.adapt_white;
    if (begins || (adapts && !was_adapting_)) meter(*picture);
    was_adapting_ = adapts;
    const float before = state.settings.display.ev100;
    if (state.auto_exposure) state.settings.display.ev100 = metering_.update(before, elapsed_s);
    workbench_.expose(state.settings.display);
    return state.settings.display.ev100 != before;
  }

  // Draws the panel as often as it takes to hand it all events, and shows the last state.
  void draw() {
    const glm::uvec2 size = window_.size();
    if (size.x == 0 || size.y == 0) return;
    // Showing waits for the device, and so would every event after. A slice that takes long
    // (shaders are being compiled) leaves the panel alive.
    const bool busy = workbench_.is_busy();
    if (busy && now_s_ - reported_s_ < alive_s) {
      redraws_ = std::max(redraws_, 1);
      return;
    }
    reported_s_ = now_s_;
    constexpr int most = 100;  // events that are handled before something is shown
    for (int i = 0; i < most; ++i) {
      controller_.draw();
      if (window_.queue().empty() || window_.closing()) break;
    }
    if (busy) {
      redraws_ = std::max(redraws_, 1);
      return;
    }
    redraws_ = std::max(0, redraws_ - 1);
    drawn_ = true;
    presenter_.fit();
    workbench_.expose(session_.state.settings.display);
    show();
  }

  void show() {
    const auto renderer_of = [](const LivePicture* live) {
      return live && live->has_picture() ? &live->renderer() : nullptr;
    };
    const render::Renderer* picture = renderer_of(workbench_.picture());
    const Comparison& compare = session_.state.compare;
    Presenter::Shown pictures{picture, renderer_of(workbench_.beside(Beside::side)), compare.line};
    if (pictures.left && !compare.changes_b) std::swap(pictures.picture, pictures.left);
    // A draft stands for the first picture, which is still to come.
    const bool is_draft = picture && workbench_.picture()->is_draft();
    const std::uint32_t shown = shown_ + (picture && new_picture_ && !is_draft);
    const bool last = options_.quit_after != 0 && shown == options_.quit_after;
    measure::Image8 grabbed;
    const bool grabs = last && !options_.screenshot.empty();
    if (!presenter_.show(pictures, grabs ? &grabbed : nullptr)) return;
    if (new_picture_ && shown_ == 0)
      spdlog::debug("the first {} is shown", is_draft ? "draft" : "picture");
    if (shown != shown_) intervals_.add(Window::now_s(), workbench_.picture()->was_in_motion());
    shown_ = shown;
    new_picture_ = false;
    if (grabs)
      measure::write_png(options_.screenshot, grabbed,
                         measure::png_text(picture->download(false).info));
  }

  ViewOptions options_;
  std::unique_ptr<Opening> first_;  // reads while window and device are made
  Presenter presenter_;
  Window& window_;  // the presenter's
  Workbench workbench_;
  Controller controller_;
  Session& session_;   // the controller's
  FrameStats& stats_;  // the controller's
  Metering metering_;
  FrameIntervals intervals_;
  bool was_auto_ = false, was_adapting_ = false;
  bool is_metered_ = true;       // the last picture
  double metered_s_ = -meter_s;  // the time when one was
  bool minimised_ = false;
  bool new_picture_ = false;  // rendered, not yet shown
  bool drawn_ = false;        // since the last slice
  int redraws_ = 3;           // of the panel, still to come
  std::uint32_t shown_ = 0;   // pictures
  double now_s_ = 0, last_step_s_ = 0, reported_s_ = 0;
};

}  // namespace

ViewReport run_viewer(const ViewOptions& options) {
  return Viewer(options).run();
}

}  // namespace nightcity::viewer
