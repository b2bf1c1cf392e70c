#include "runtime/viewer/controller.h"

#include <fmt/format.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "formats/error.h"
#include "runtime/render/presets.h"
#include "runtime/scene/scene_file.h"
#include "runtime/viewer/compass.h"
#include "runtime/viewer/drawing.h"
#include "runtime/viewer/errand.h"
#include "runtime/viewer/hands.h"
#include "runtime/viewer/legend.h"
#include "runtime/viewer/measured.h"
#include "runtime/viewer/places.h"
#include "runtime/viewer/view_choice.h"
#include "runtime/viewer/window_settings.h"

namespace nightcity::viewer {

Controller::Controller(const ViewOptions& options, Presenter& presenter, Workbench& workbench)
    : options_(options),
      presenter_(presenter),
      window_(presenter.window()),
      workbench_(workbench),
      lights_(session_, workbench),
      films_(options, session_),
      pictures_(options, session_, workbench) {
  session_.state = make_state(options);
  stats_.device = presenter.device().label();
  stats_.trace = gpu::name_of(presenter.device().trace());
  stats_.cities = options.scenes;
}

std::unique_ptr<Opening> Controller::start_opening(const ViewOptions& options,
                                                   const std::string& path) {
  return std::make_unique<Opening>(path, options.camera, options.settings, options.load);
}

Views Controller::views() const {
  // A film needs the device more than a mean that nobody waits for.
  constexpr std::uint32_t frames_beside_film = 16;
  ViewConditions conditions;
  conditions.window = window_.size();
  conditions.max_frames = options_.max_frames;
  if (films()) conditions.max_frames = std::min(conditions.max_frames, frames_beside_film);
  conditions.runs = session_.clock_runs() && !workbench_.is_saving();
  conditions.switches = workbench_.has_city() && workbench_.city().on_device->switching();
  return choose_views(session_.state, conditions);
}

bool Controller::finish_opening() {
  try {
    if (!workbench_.finish_opening(window_.size())) return false;
  } catch (const std::exception& error) {
    if (!workbench_.has_city()) throw;  // there is nothing else to show
    session_.notices.say(error.what(), now_s_, true);
    return false;
  }
  workbench_.hold_beside(choose_beside(session_.state));
  const City& city = workbench_.city();
  spdlog::debug("{} is opened", city.path);
  std::filesystem::path bookmarks = city.path;
  place_text_.clear();
  session_.open(city.pose, bookmarks.replace_extension(".cameras.json"), now_s_);
  session_.state.night_changes = !city.scene.traffic.trips.empty() || !city.scene.schedules.empty();
  lights_.open();
  films_.open();
  if (!city.notice.empty()) session_.notices.say(city.notice, now_s_);
  describe_city(city, stats_);
  if (!stats_.has_light)
    session_.notices.say(
        "no lights: no .lights file lies beside this scene. The panel offers "
        "sky and moon.",
        now_s_, true);
  return true;
}

void Controller::open(const std::string& path) {
  if (workbench_.opening()) return;
  if (std::find(stats_.cities.begin(), stats_.cities.end(), path) == stats_.cities.end())
    stats_.cities.push_back(path);
  workbench_.open(start_opening(options_, path));
}

void Controller::open_next(int steps) {
  const auto& cities = stats_.cities;
  const auto shown = std::find(cities.begin(), cities.end(), workbench_.city().path);
  if (cities.size() < 2 || shown == cities.end()) {
    session_.notices.say("no other city: drop one on the window", now_s_);
    return;
  }
  const auto count = static_cast<std::ptrdiff_t>(cities.size());
  open(cities[static_cast<std::size_t>((shown - cities.begin() + steps + count) % count)]);
}

void Controller::describe_work() {
  stats_.work = workbench_.describe();
  stats_.films = films_.films();
  if (stats_.films) stats_.work += (stats_.work.empty() ? "" : "; ") + films_.progress(now_s_);
  const LivePicture* reference = workbench_.beside(Beside::reference);
  const bool has_mean = reference && workbench_.picture()->is_like(*reference);
  stats_.reference = !reference ? ""
                     : has_mean ? describe_reference(reference->renderer())
                                : std::string("no frame of the reference yet");
}

void Controller::draw() {
  workbench_.hold_beside(choose_beside(session_.state));
  describe_work();
  presenter_.overlay().begin(window_.queue());
  const glm::vec2 size(window_.size());
  if (workbench_.has_city())
    handle_input(size);
  else
    handle_early_input();
  ViewerState& state = session_.state;
  if (state.show_panel) describe_memory(presenter_.device(), stats_);
  if (state.show_panel && workbench_.has_city()) {
    const City& city = workbench_.city();
    stats_.place = describe_place(city.scene, *city.projection, state.camera.pose);
  }
  const PanelRequests requests = state.show_panel ? draw_panel(state, stats_) : PanelRequests{};
  if (workbench_.has_city())
    draw_city(size);
  else
    draw_opening(size);
  draw_lines(state, stats_, session_.notices, size);
  draw_help(state.show_help, size);
  presenter_.overlay().end();
  obey(requests);
}

void Controller::draw_opening(const glm::vec2& size) {
  const Opening* opening = workbench_.opening();
  draw_middle(
      fmt::format("opening {}: {}", name_of(opening ? opening->path() : options_.scenes.front()),
                  stats_.work),
      size);
}

void Controller::draw_city(const glm::vec2& size) {
  const scene::RenderScene& scene = workbench_.city().scene;
  ViewerState& state = session_.state;
  if (state.compare.on) draw_comparison(state.compare, state.settings, size);
  draw_legend(state.settings.display, stats_.reference, size);
  if (state.markers) draw_markers(scene, state.camera.pose, size);
  look_at_pick();
  draw_pick(session_.picked, pick_cd_m2_, scene, state.camera.pose, size);
  lights_.draw(now_s_);
  if (session_.measured_from)
    draw_measured(*session_.measured_from,
                  session_.picked ? session_.picked->point : *session_.measured_from,
                  state.camera.pose, size);
  draw_compass(state.camera, size);
  window_.set_title(fmt::format("{} - {} - nightview", stats_.scene, caption(state, stats_)));
}

// Finds the luminance that the picture has where something was picked. The last one is kept while
// the device is at work.
void Controller::look_at_pick() {
  if (!session_.picked || workbench_.picture()->is_busy()) return;
  pick_cd_m2_ = workbench_.picture()->luminance_at(session_.picked->point).value_or(pick_cd_m2_);
}

// While the first scene is opened, there is nothing to move through.
void Controller::handle_early_input() {
  InputQueue& queue = window_.queue();
  for (const int key : queue.pressed()) {
    const auto press = find_action(key, queue.modifiers());
    if (!press || (press->action == Action::close && close_innermost())) continue;
    obey(session_.press(*press, nullptr, Background::nothing, now_s_));
  }
  queue.held().take_all(Window::now_s());  // what is held counts from the first picture on
}

Background Controller::find_background() const {
  if (workbench_.is_saving()) return Background::picture;
  return films_.films() ? Background::film : Background::nothing;
}

void Controller::handle_input(const glm::vec2& size) {
  const scene::RenderScene& scene = workbench_.city().scene;
  InputQueue& queue = window_.queue();
  for (const int key : queue.pressed()) {
    const auto press = find_action(key, queue.modifiers());
    if (!press) continue;
    if (press->action == Action::close && close_innermost()) continue;
    obey(session_.press(*press, &scene, find_background(), now_s_));
  }
  Hands hands = read_hands(ImGui::GetIO(), queue.held(), queue.handed_until(Window::now_s()));
  if (pad_)
    for (const Action action : gamepad_.apply(*pad_, now_s_ - pad_s_, hands))
      obey(session_.press({action}, &scene, find_background(), now_s_));
  pad_s_ = now_s_;
  films_.follow(now_s_);
  const scene::CameraPose before = session_.state.camera.pose;
  session_.move(hands, scene, size, now_s_);
  if (before.position != session_.state.camera.pose.position ||
      before.target != session_.state.camera.pose.target)
    moved_s_ = now_s_;
}

void Controller::obey(const WindowRequests& requests) {
  obey_for_window(requests);
  if (requests.cancel_picture) pictures_.cancel(now_s_);
  if (requests.compare) toggle_comparison();
  if (requests.switch_light)
    lights_.edit([](LightEdit& edit) { edit.is_off = !edit.is_off; }, now_s_);
  if (requests.brighten != 1)
    lights_.edit([&](LightEdit& edit) { edit.flux_lm = *edit.flux_lm * requests.brighten; },
                 now_s_);
  if (requests.save_edits) lights_.save(now_s_);
  if (requests.record_path) films_.toggle_path(workbench_.city().path, now_s_);
  if (requests.film) film();
  if (requests.stop_film) films_.stop(now_s_);
  if (requests.save_settings) save_settings();
  if (requests.save_picture) pictures_.begin(views().view, now_s_);
}

void Controller::obey_for_window(const WindowRequests& requests) {
  if (requests.close) window_.close();
  if (requests.fullscreen) window_.toggle_fullscreen();
  if (requests.copy_camera) {
    window_.set_clipboard(scene::to_text(session_.state.camera.pose));
    session_.notices.say("camera copied", now_s_);
  }
  if (requests.paste_camera) session_.paste_camera(window_.clipboard(), now_s_);
  if (requests.next_city != 0) open_next(requests.next_city);
  if (requests.larger_text != 0) {
    float& scale = ImGui::GetIO().FontGlobalScale;
    scale = std::clamp(scale + 0.25f * float(requests.larger_text), 0.5f, 4.0f);
  }
}

void Controller::obey(const PanelRequests& requests) {
  if (!requests.camera_preset.empty())
    session_.go_to(scene::find_camera(requests.camera_preset, workbench_.city().scene), now_s_);
  if (requests.compare) toggle_comparison();
  if (requests.change_side) {
    session_.change_side();
    workbench_.exchange();
  }
  if (requests.show) session_.show(*requests.show, now_s_);
  if (!requests.go_to.empty())
    run_errand(session_.notices, now_s_, [&] { return go_to_place(requests.go_to); });
  if (!requests.preset.empty())
    render::apply_preset(render::find_device_class(presenter_.device().info().kind),
                         requests.preset, session_.state.settings,
                         [](const std::string&) { return false; });
  if (requests.save_settings) save_settings();
  if (requests.save) pictures_.begin(views().view, now_s_);
  if (requests.film) film();
  if (requests.stop_film) films_.stop(now_s_);
  if (!requests.open.empty()) open(requests.open);
}

void Controller::toggle_comparison() {
  session_.toggle_comparison();
  workbench_.hold_beside(choose_beside(session_.state));
}

std::string Controller::go_to_place(const std::string& text) {
  const City& city = workbench_.city();
  place_turn_ = text == place_text_ ? place_turn_ + 1 : 0;
  place_text_ = text;
  const Place place = find_place(text, city.scene, *city.projection, place_turn_);
  session_.go_to(look_at_place(place, session_.state.camera.pose), now_s_);
  if (session_.state.camera.motion == Motion::walk && !place.stand)
    session_.state.camera.motion = Motion::orbit;  // a walker would fall from there
  return place.name;
}

void Controller::film() {
  films_.begin(workbench_.city().path, lights_.edits(), glm::max(window_.size(), glm::uvec2(1)),
               now_s_);
}

void Controller::save_settings() {
  run_errand(session_.notices, now_s_,
             [this] { return viewer::save_settings(options_.settings_file, session_.state); });
}

}  // namespace nightcity::viewer
