#include "runtime/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>

#include "formats/error.h"
#include "formats/program/progress_display.h"
#include "runtime/measure/png.h"
#include "runtime/render/parse.h"
#include "runtime/scene/markers.h"
#include "runtime/viewer/closing_signals.h"
#include "runtime/viewer/drawing.h"
#include "runtime/viewer/hands.h"
#include "runtime/viewer/live_picture.h"
#include "runtime/viewer/overlay.h"
#include "runtime/viewer/picture_names.h"
#include "runtime/viewer/screen.h"
#include "runtime/viewer/session.h"
#include "runtime/viewer/swapchain.h"
#include "runtime/viewer/window.h"

namespace nightcity::viewer {
namespace {

// The longest that the loop waits for the device before it looks at the input again.
constexpr double wait_s = 0.004;
// The panel waits so long for a slice of the device before it is drawn without being shown.
constexpr double alive_s = 0.05;
// The line about what goes on is written anew so often.
constexpr double report_s = 0.25;
// A sleeping window looks for a signal so often.
constexpr double sleep_s = 0.1;

gpu::Device::Options for_window(gpu::Device::Options options, const Window& window) {
  options.instance_extensions = window.instance_extensions();
  options.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return options;
}

float font_of(const ViewOptions& options, const Window& window) {
  constexpr float standard_px = 13;
  return options.font_px > 0 ? options.font_px : standard_px * window.content_scale();
}

// Returns the file that keeps the places of panels, "" without a home (XDG Base Directory
// Specification).
std::filesystem::path find_places_file() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (config && *config == '/')
    folder = config;
  else if (home && *home)
    folder = std::filesystem::path(home) / ".config";
  return folder.empty() ? folder : folder / "nightcity" / "window.ini";
}

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

class Viewer {
 public:
  explicit Viewer(const ViewOptions& options)
      : options_(options),
        opening_(open(options.scenes.front())),
        window_(options.width, options.height, "nightview"),
        device_(for_window(options.device, window_)),
        swapchain_(device_, window_.create_surface(device_.instance())),
        passes_(device_),
        screen_(device_),
        black_(device_, 4) {
    opening_->set_device(device_);
    black_.fill_zero();
    ViewerState& state = session_.state;
    state.settings = options.settings;
    state.markers = options.markers;
    state.divisor = options.divisor;
    state.auto_exposure = !options.ev100;
    if (options.ev100) state.settings.display.ev100 = *options.ev100;
    state.play = options.play;
    stats_.device = device_.label();
    stats_.cities = options.scenes;
    swapchain_.resize(window_.size());
    overlay_ = std::make_unique<Overlay>(device_, window_, swapchain_, font_of(options, window_));
    if (const auto places = find_places_file(); !places.empty()) overlay_->load_places(places);
  }

  ViewReport run() {
    const ClosingSignals signals;
    while (!window_.closing() && !ClosingSignals::came() &&
           (options_.quit_after == 0 || shown_ < options_.quit_after))
      step();
    window_.hide();
    if (picture_) picture_->stop();
    keep_places();
    if (!options_.save_camera.empty())
      scene::write_camera(options_.save_camera, session_.state.camera.pose);
    device_.check_validation();
    return {shown_, stats_.frames, render::name_of(session_.state.settings.sampling.estimator)};
  }

 private:
  std::unique_ptr<Opening> open(const std::string& path) {
    return std::make_unique<Opening>(path, options_.camera, options_.settings.time_s,
                                     options_.load);
  }

  // A home that takes no files is no reason to fail.
  void keep_places() const {
    const std::filesystem::path places = find_places_file();
    if (places.empty()) return;
    try {
      overlay_->save_places(places);
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
    finish_opening();
    for (const std::string& path : window_.take_dropped()) drop(path);
    const double elapsed_s = now_s_ - last_step_s_;
    last_step_s_ = now_s_;
    if (job_ == nullptr)  // lights have one time, which is that of the picture being saved
      session_.run_clock(options_.time_step_s > 0 && !pictured ? 0 : elapsed_s,
                         pictured ? options_.time_step_s : 0, now_s_);
    // After news the panel is drawn a few times more: it settles within two frames.
    if (window_.queue().held().any()) redraws_ = std::max(redraws_, 1);
    if (window_.take_news() || outdated_ || minimised_) redraws_ = 3;
    minimised_ = false;
    const bool reports = (works() || opening_) && now_s_ - reported_s_ > report_s;
    if (!pictured && redraws_ == 0 && !reports && !session_.notices.expire(now_s_) &&
        window_.queue().empty() && !adapt_exposure(elapsed_s))
      return;
    if (pictured) adapt_exposure(elapsed_s);
    new_picture_ |= pictured;
    draw();
  }

  bool is_busy() const { return (picture_ && picture_->is_busy()) || (job_ && job_->is_busy()); }

  bool works() const { return job_ || (picture_ && !picture_->rests(view(), now_s_)); }

  double find_sleep_s() const {
    if (window_.is_minimised()) return sleep_s;
    if (picture_ && picture_->compiles()) return 0.01;
    if (works() || !window_.queue().empty() || redraws_ > 0 || new_picture_) return 0;
    if (opening_) return 0.02;
    return sleep_s;
  }

  View view() const {
    const ViewerState& state = session_.state;
    View view{state.camera.pose, state.settings, glm::max(window_.size(), glm::uvec2(1))};
    view.settings.averaging.accumulate = state.accumulate;
    view.divisor = static_cast<std::uint32_t>(state.divisor);
    view.max_frames = options_.max_frames;
    view.runs = session_.clock_runs() && !job_;
    view.switches = city_ && city_->on_device->switching();
    return view;
  }

  // Works a slice at a picture. Returns whether the window has a new one to show.
  bool work() {
    if (!city_ || window_.is_minimised()) return false;
    // A picture that is ready is shown before the next slice is rendered.
    if (redraws_ > 0 || new_picture_ || !window_.queue().empty()) {
      if (picture_->is_busy() && !picture_->wait(wait_s)) return false;
      if (job_ && job_->is_busy() && !job_->wait(wait_s)) return false;
      if (!std::exchange(drawn_, false)) return false;
    }
    // A picture that is saved waits while the view moves, until the window shows where it went.
    const bool job_next = now_s_ - moved_s_ > Refinement::rest_s && picture_->shows(view());
    if (job_ && !picture_->is_busy() && (job_->is_busy() || job_next)) {
      picture_->stop();  // the vehicles of the scene stand where the job has them
      if (job_->work(wait_s)) finish_job();
      return false;
    }
    if (!picture_->work(view(), now_s_, wait_s)) return false;
    const render::Renderer& renderer = picture_->renderer();
    stats_.width = renderer.width();
    stats_.height = renderer.height();
    stats_.divisor = picture_->shown().divisor;
    stats_.frames = renderer.frames();
    stats_.made_with = picture_->made_with();
    stats_.passes = renderer.timings();
    stats_.frame_ms = 1000 * renderer.frame_s();
    if (session_.state.auto_exposure) metering_.set_target(picture_->meter());
    return true;
  }

  // Returns whether the exposure of the picture on the screen changed.
  bool adapt_exposure(double elapsed_s) {
    if (!picture_ || picture_->is_busy() || !picture_->has_picture()) return false;
    ViewerState& state = session_.state;
    if (state.auto_exposure && !was_auto_) {
      metering_.restart();
      metering_.set_target(picture_->meter());
    }
    was_auto_ = state.auto_exposure;
    const float before = state.settings.display.ev100;
    if (state.auto_exposure) state.settings.display.ev100 = metering_.update(before, elapsed_s);
    picture_->expose(state.settings.display);
    return state.settings.display.ev100 != before;
  }

  void finish_opening() {
    if (!opening_ || !opening_->is_done() || (picture_ && picture_->is_busy())) return;
    const std::unique_ptr<Opening> done = std::move(opening_);
    std::unique_ptr<City> city;
    try {
      city = done->take();
    } catch (const std::exception& error) {
      if (!city_) throw;  // there is nothing else to show
      session_.notices.say(error.what(), now_s_, true);
      return;
    }
    job_.reset();
    picture_.reset();  // before the scene that it renders
    city_ = std::move(city);
    picture_ = std::make_unique<LivePicture>(device_, passes_, *city_->on_device, window_.size());
    const scene::RenderScene& scene = city_->scene;
    std::filesystem::path bookmarks = city_->path;
    session_.open(city_->pose, bookmarks.replace_extension(".cameras.json"), now_s_);
    session_.state.night_changes = !scene.traffic.trips.empty() || !scene.schedules.empty();
    stats_.scene = name_of(city_->path);
    stats_.triangles = city_->triangles;
    stats_.lights = scene.lights.size();
    stats_.has_light = !scene.lights.empty() || !scene.traffic.trips.empty();
    stats_.licences = scene.georeference.licences;
    if (!stats_.has_light)
      session_.notices.say(
          "no lights: no .lights file lies beside this scene. The panel offers "
          "sky and moon.",
          now_s_, true);
    metering_.restart();
    redraws_ = 3;
  }

  void drop(const std::string& path) {
    if (opening_) return;
    if (std::find(stats_.cities.begin(), stats_.cities.end(), path) == stats_.cities.end())
      stats_.cities.push_back(path);
    opening_ = open(path);
    opening_->set_device(device_);
  }

  // Draws the panel as often as it takes to hand it all events, and shows the last state.
  void draw() {
    const glm::uvec2 size = window_.size();
    if (size.x == 0 || size.y == 0) return;
    // Showing waits for the device, and so would every event after. A slice that takes long (shaders
    // are being compiled) leaves the panel alive.
    const bool busy = is_busy();
    if (busy && now_s_ - reported_s_ < alive_s) {
      redraws_ = std::max(redraws_, 1);
      return;
    }
    reported_s_ = now_s_;
    constexpr int most = 100;  // events that are handled before something is shown
    for (int i = 0; i < most; ++i) {
      draw_panel_once();
      if (window_.queue().empty() || window_.closing()) break;
    }
    if (busy) {
      redraws_ = std::max(redraws_, 1);
      return;
    }
    redraws_ = std::max(0, redraws_ - 1);
    drawn_ = true;
    if (size != swapchain_.size() || outdated_) swapchain_.resize(size);
    outdated_ = false;
    if (picture_) picture_->expose(session_.state.settings.display);
    show();
  }

  void draw_panel_once() {
    describe_work();
    overlay_->begin(window_.queue());
    const glm::vec2 size(window_.size());
    ViewerState& state = session_.state;
    PanelRequests requests;
    if (city_) {
      handle_input(size);
      if (state.show_panel) stats_.place = describe_camera(city_->scene, state.camera.pose);
      if (state.show_panel) requests = draw_panel(state, stats_);
      if (state.markers) draw_markers(city_->scene, state.camera.pose, size);
      draw_pick(session_.picked, luminance_at_pick(size), city_->scene, state.camera.pose, size);
      draw_lines(state, stats_, session_.notices, size);
      window_.set_title(fmt::format("{} - {} - nightview", stats_.scene, caption(state, stats_)));
    } else {
      handle_early_input();
      draw_middle(
          fmt::format("opening {}: {}",
                      name_of(opening_ ? opening_->path() : options_.scenes.front()), stats_.work),
          size);
    }
    draw_help(state.show_help, size);
    overlay_->end();
    if (!requests.camera_preset.empty()) go_to_preset(requests.camera_preset);
    if (requests.save) save();
    if (!requests.open.empty()) drop(requests.open);
  }

  void describe_work() {
    stats_.work.clear();
    if (opening_) {
      stats_.work = fmt::format("{}, {:.0f} s", opening_->stage(), opening_->elapsed_s());
      if (city_) stats_.work = "opening " + name_of(opening_->path()) + ": " + stats_.work;
    } else if (job_) {
      stats_.work = job_->progress();
    } else if (picture_ && picture_->compiles()) {
      stats_.work = "compiling shaders";
    } else if (picture_ && !picture_->is_fine() && picture_->share_done() > 0) {
      const std::uint32_t divisor = picture_->plan().divisor;
      stats_.work = fmt::format(
          "refining, {:.0f} % of {}", 100 * picture_->share_done(),
          divisor == 1 ? "every pixel" : fmt::format("one pixel in {}", divisor * divisor));
    }
  }

  // Returns the luminance that the picture has where something was picked, cd/m2.
  double luminance_at_pick(const glm::vec2& size) {
    if (!session_.picked || picture_->is_busy() || !picture_->has_picture()) return pick_cd_m2_;
    const gpu::Camera camera = scene::make_camera(session_.state.camera.pose, size.x / size.y);
    const auto at = scene::project(camera, session_.picked->point);
    if (!at || at->x < 0 || at->y < 0 || at->x >= 1 || at->y >= 1) return pick_cd_m2_;
    const render::Renderer& renderer = picture_->renderer();
    const glm::vec3 mean = renderer.mean_at(
        glm::uvec2(*at * glm::vec2(float(renderer.width()), float(renderer.height()))));
    return pick_cd_m2_ = double(tonemap::luminance_709(mean.r, mean.g, mean.b));
  }

  // While the first scene loads, there is nothing to move through.
  void handle_early_input() {
    for (const int key : window_.queue().pressed())
      if (const auto press = find_action(key, window_.queue().modifiers());
          press && press->action == Action::close)
        window_.close();
      else if (press && press->action == Action::help)
        session_.state.show_help = !session_.state.show_help;
  }

  void handle_input(const glm::vec2& size) {
    InputQueue& queue = window_.queue();
    for (const int key : queue.pressed()) {
      const auto press = find_action(key, queue.modifiers());
      if (!press) continue;
      if (press->action == Action::close && close_innermost()) continue;
      obey(session_.press(*press, city_->scene, job_ != nullptr, now_s_));
    }
    const Hands hands =
        read_hands(ImGui::GetIO(), queue.held(), queue.handed_until(Window::now_s()));
    const scene::CameraPose before = session_.state.camera.pose;
    session_.move(hands, city_->scene, size, now_s_);
    if (before.position != session_.state.camera.pose.position ||
        before.target != session_.state.camera.pose.target)
      moved_s_ = now_s_;
  }

  void obey(const WindowRequests& requests) {
    if (requests.close) window_.close();
    if (requests.cancel_picture) {
      job_.reset();
      session_.notices.say("the picture is not saved", now_s_);
    }
    if (requests.save_picture) save();
    if (requests.fullscreen) window_.toggle_fullscreen();
    if (requests.copy_camera) {
      window_.set_clipboard(scene::to_text(session_.state.camera.pose));
      session_.notices.say("camera copied", now_s_);
    }
    if (requests.paste_camera) session_.paste_camera(window_.clipboard(), now_s_);
    if (requests.larger_text != 0) {
      float& scale = ImGui::GetIO().FontGlobalScale;
      scale = std::clamp(scale + 0.25f * float(requests.larger_text), 0.5f, 4.0f);
    }
  }

  void go_to_preset(const std::string& preset) {
    session_.go_to(scene::find_camera(preset, city_->scene), now_s_);
  }

  // Saves what is on the screen where that has the quality asked for; else renders it first.
  void save() {
    if (job_ || !picture_) {
      session_.notices.say("a picture is being saved already", now_s_);
      return;
    }
    picture_->stop();  // the job switches the scene's lights to its own time
    job_ =
        std::make_unique<PictureJob>(device_, passes_, *city_->on_device, view(), options_.picture);
  }

  void finish_job() {
    const std::unique_ptr<PictureJob> job = std::move(job_);
    try {
      measure::Image image = job->download();
      image.info.licences = scene::describe_licences(city_->scene);
      image.info.camera = scene::to_text(job->pose());
      image.info.time = render::time_text(job->settings().time_s);
      const std::string sentence = save_picture(find_picture_folder(options_.picture_folder), image,
                                                session_.state.settings.display);
      session_.notices.say(sentence, now_s_);
      spdlog::info("{}", sentence);
    } catch (const std::exception& error) {  // a full disk is no reason to close the window
      session_.notices.say(fmt::format("the picture is not saved: {}", error.what()), now_s_, true);
      spdlog::error("{}", error.what());
    }
    redraws_ = 3;
  }

  void show() {
    if (!swapchain_.acquire()) {
      outdated_ = true;
      return;
    }
    const bool shows_picture = picture_ && picture_->has_picture();
    shown_ += shows_picture && new_picture_;
    const bool last = options_.quit_after != 0 && shown_ == options_.quit_after;
    measure::Image8 grabbed;
    measure::Image8* grab = last && !options_.screenshot.empty() ? &grabbed : nullptr;
    const auto overlay = [this](VkCommandBuffer commands) { overlay_->record(commands); };
    outdated_ = shows_picture
                    ? !screen_.show(swapchain_, picture_->renderer().display(),
                                    {picture_->renderer().width(), picture_->renderer().height()},
                                    overlay, grab)
                    : !screen_.show(swapchain_, black_, {1, 1}, overlay);
    new_picture_ = false;
    if (grab)
      measure::write_png(options_.screenshot, grabbed,
                         measure::png_text(picture_->renderer().download(false).info));
  }

  ViewOptions options_;
  std::unique_ptr<Opening> opening_;  // reads while window and device are made
  Window window_;
  gpu::Device device_;
  Swapchain swapchain_;
  render::PassLibrary passes_;
  Screen screen_;
  gpu::Buffer black_;  // a picture of one pixel, shown before the first
  std::unique_ptr<Overlay> overlay_;
  std::unique_ptr<City> city_;
  std::unique_ptr<LivePicture> picture_;  // of city_
  std::unique_ptr<PictureJob> job_;
  Session session_;
  Metering metering_;
  FrameStats stats_;
  bool was_auto_ = false;
  bool outdated_ = false;  // the swapchain no longer fits the window
  bool minimised_ = false;
  bool new_picture_ = false;  // rendered, not yet shown
  double pick_cd_m2_ = 0;     // luminance where something was picked, when last looked at
  bool drawn_ = false;        // since the last slice
  int redraws_ = 3;           // of the panel, still to come
  std::uint32_t shown_ = 0;   // pictures
  double now_s_ = 0, last_step_s_ = 0, reported_s_ = 0, moved_s_ = -1e9;
};

}  // namespace

ViewReport run_viewer(const ViewOptions& options) {
  return Viewer(options).run();
}

}  // namespace nightcity::viewer
