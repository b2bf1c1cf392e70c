#include "runtime/viewer/controller.h"

#include <fmt/format.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "formats/error.h"
#include "runtime/render/presets.h"
#include "runtime/scene/scene_file.h"
#include "runtime/viewer/compass.h"
#include "runtime/viewer/drawing.h"
#include "runtime/viewer/hands.h"
#include "runtime/viewer/legend.h"
#include "runtime/viewer/measured.h"
#include "runtime/viewer/picture_names.h"
#include "runtime/viewer/places.h"
#include "runtime/viewer/window_settings.h"

namespace nightcity::viewer {

Controller::Controller(const ViewOptions& options, Presenter& presenter, Workbench& workbench)
    : options_(options), presenter_(presenter), window_(presenter.window()), workbench_(workbench) {
  ViewerState& state = session_.state;
  state.settings = options.settings;
  if (options.compared) {
    state.compare.on = true;
    state.compare.other = *options.compared;
  }
  state.markers = options.markers;
  state.divisor = options.divisor;
  state.governor = options.governor;
  state.budget_ms = static_cast<float>(options.governor.budget_ms);
  state.target_error = static_cast<float>(options.governor.target_error);
  state.auto_exposure = !options.ev100;
  if (options.ev100) state.settings.display.ev100 = *options.ev100;
  state.play = options.play;
  stats_.device = presenter.device().label();
  stats_.trace = gpu::name_of(presenter.device().trace());
  stats_.cities = options.scenes;
}

std::unique_ptr<Opening> Controller::start_opening(const ViewOptions& options,
                                                   const std::string& path) {
  return std::make_unique<Opening>(path, options.camera, options.settings.time_s,
                                   options.settings.environment.lights, options.load);
}

View Controller::view_of(const render::RenderSettings& settings) const {
  const ViewerState& state = session_.state;
  View view{state.camera.pose, settings, glm::max(window_.size(), glm::uvec2(1))};
  view.settings.sampling.layers |= render::needs_layers(view.settings.display.view);
  view.settings.averaging.accumulate = state.accumulate;
  view.divisor = static_cast<std::uint32_t>(state.divisor);
  view.max_frames = options_.max_frames;
  view.runs = session_.clock_runs() && !workbench_.is_saving();
  view.governor = state.governor;
  view.switches = workbench_.has_city() && workbench_.city().on_device->switching();
  return view;
}

Views Controller::views() const {
  const ViewerState& state = session_.state;
  Views views{view_of(state.settings), std::nullopt, true};
  if (!state.compare.on) return views;
  render::RenderSettings other = state.compare.other;
  const bool denoise = other.display.denoise;
  other.display = state.settings.display;
  other.display.denoise = denoise;
  views.other = view_of(other);
  views.view.governor = views.other->governor = {};  // two pictures share the device
  views.same_lights = have_same_lights(state.settings, other);
  if (views.same_lights) return views;
  // Each change of lights begins a mean anew, so each side gets its frames at one go.
  constexpr std::uint32_t frames_by_turns = 16;
  views.view.max_frames = views.other->max_frames = std::min(options_.max_frames, frames_by_turns);
  return views;
}

bool Controller::finish_opening() {
  try {
    if (!workbench_.finish_opening(window_.size())) return false;
  } catch (const std::exception& error) {
    if (!workbench_.has_city()) throw;  // there is nothing else to show
    session_.notices.say(error.what(), now_s_, true);
    return false;
  }
  workbench_.compare(session_.state.compare.on);
  const City& city = workbench_.city();
  std::filesystem::path bookmarks = city.path;
  place_text_.clear();
  session_.open(city.pose, bookmarks.replace_extension(".cameras.json"), now_s_);
  session_.state.night_changes = !city.scene.traffic.trips.empty() || !city.scene.schedules.empty();
  editor_ = workbench_.city().edits;
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

void Controller::draw() {
  stats_.work = workbench_.describe();
  presenter_.overlay().begin(window_.queue());
  const glm::vec2 size(window_.size());
  PanelRequests requests;
  if (workbench_.has_city()) {
    draw_city(size, requests);
  } else {
    handle_early_input();
    const Opening* opening = workbench_.opening();
    draw_middle(
        fmt::format("opening {}: {}", name_of(opening ? opening->path() : options_.scenes.front()),
                    stats_.work),
        size);
  }
  draw_help(session_.state.show_help, size);
  presenter_.overlay().end();
  obey(requests);
}

void Controller::draw_city(const glm::vec2& size, PanelRequests& requests) {
  const scene::RenderScene& scene = workbench_.city().scene;
  ViewerState& state = session_.state;
  handle_input(size);
  if (state.show_panel) stats_.place = describe_place();
  if (state.show_panel) describe_memory(presenter_.device(), stats_);
  if (state.show_panel) requests = draw_panel(state, stats_);
  if (state.compare.on) draw_comparison(state.compare, state.settings, size);
  draw_legend(state.settings.display, size);
  if (state.markers) draw_markers(scene, state.camera.pose, size);
  look_at_pick();
  draw_pick(session_.picked, pick_cd_m2_, scene, state.camera.pose, size);
  if (session_.picked && session_.picked->emitter) draw_editor();
  if (session_.measured_from)
    draw_measured(*session_.measured_from,
                  session_.picked ? session_.picked->point : *session_.measured_from,
                  state.camera.pose, size);
  draw_compass(state.camera, size);
  draw_lines(state, stats_, session_.notices, size);
  window_.set_title(fmt::format("{} - {} - nightview", stats_.scene, caption(state, stats_)));
}

std::string Controller::describe_place() const {
  const City& city = workbench_.city();
  const scene::CameraPose& pose = session_.state.camera.pose;
  std::string text = describe_camera(city.scene, pose);
  const glm::dvec3 plane = city.scene.georeference.from_model(glm::dvec3(pose.position));
  if (const auto degrees = city.projection->to_degrees({plane.x, plane.y}))
    text += fmt::format("\n{:.5f}, {:.5f} (latitude, longitude)", degrees->x, degrees->y);
  return text;
}

// Finds the luminance that the picture has where something was picked. The last one is kept while
// the device is at work.
void Controller::look_at_pick() {
  if (!session_.picked || workbench_.picture()->is_busy()) return;
  pick_cd_m2_ = workbench_.picture()->luminance_at(session_.picked->point).value_or(pick_cd_m2_);
}

// While the first scene loads, there is nothing to move through.
void Controller::handle_early_input() {
  for (const int key : window_.queue().pressed())
    if (const auto press = find_action(key, window_.queue().modifiers());
        press && press->action == Action::close)
      window_.close();
    else if (press && press->action == Action::help)
      session_.state.show_help = !session_.state.show_help;
}

void Controller::handle_input(const glm::vec2& size) {
  const scene::RenderScene& scene = workbench_.city().scene;
  InputQueue& queue = window_.queue();
  for (const int key : queue.pressed()) {
    const auto press = find_action(key, queue.modifiers());
    if (!press) continue;
    if (press->action == Action::close && close_innermost()) continue;
    obey(session_.press(*press, scene, workbench_.is_saving(), now_s_));
  }
  Hands hands = read_hands(ImGui::GetIO(), queue.held(), queue.handed_until(Window::now_s()));
  if (pad_)
    for (const Action action : gamepad_.apply(*pad_, now_s_ - pad_s_, hands))
      obey(session_.press({action}, scene, workbench_.is_saving(), now_s_));
  pad_s_ = now_s_;
  recorder_.follow(session_.state.camera.pose, now_s_);
  const scene::CameraPose before = session_.state.camera.pose;
  session_.move(hands, scene, size, now_s_);
  if (before.position != session_.state.camera.pose.position ||
      before.target != session_.state.camera.pose.target)
    moved_s_ = now_s_;
}

void Controller::obey(const WindowRequests& requests) {
  if (requests.close) window_.close();
  if (requests.cancel_picture) {
    workbench_.stop_saving();
    session_.notices.say("the picture is not saved", now_s_);
  }
  if (requests.compare) toggle_comparison();
  if (requests.switch_light) edit_light([](LightEdit& edit) { edit.is_off = !edit.is_off; });
  if (requests.brighten != 1)
    edit_light([&](LightEdit& edit) { edit.flux_lm = *edit.flux_lm * requests.brighten; });
  if (requests.save_edits) save_edits();
  if (requests.record_path) toggle_recording();
  if (requests.save_settings) save_settings();
  if (requests.save_picture) save();
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
  if (!requests.go_to.empty()) run([&] { return go_to_place(requests.go_to); });
  if (!requests.preset.empty())
    render::apply_preset(render::find_device_class(presenter_.device().info().kind),
                         requests.preset, session_.state.settings,
                         [](const std::string&) { return false; });
  if (requests.save_settings) save_settings();
  if (requests.save) save();
  if (!requests.open.empty()) open(requests.open);
}

void Controller::toggle_comparison() {
  session_.toggle_comparison();
  workbench_.compare(session_.state.compare.on);
}

void Controller::draw_editor() {
  City& city = workbench_.city();
  const std::size_t light = session_.picked->emitter->light;
  LightEdit edit = editor_.edit_of(city.scene.lights[light]);
  bool saves = false;
  if (draw_light_editor(edit, editor_.original_of(city.scene, light), editor_.is_unsaved(), saves))
    edit_light([&](LightEdit& changed) { changed = edit; });
  if (saves) save_edits();
}

void Controller::edit_light(const std::function<void(LightEdit&)>& change) {
  std::optional<Pick>& picked = session_.picked;
  if (!picked || !picked->emitter) {
    session_.notices.say("click a lamp or window first", now_s_);
    return;
  }
  City& city = workbench_.city();
  const std::size_t light = picked->emitter->light;
  LightEdit edit = editor_.edit_of(city.scene.lights[light]);
  const double original_lm = double(editor_.original_of(city.scene, light).flux_lm);
  if (!edit.flux_lm) edit.flux_lm = original_lm;
  change(edit);
  if (edit.flux_lm) {
    edit.flux_lm = std::clamp(*edit.flux_lm, original_lm / 1000, original_lm * 1000);
    if (std::abs(*edit.flux_lm / original_lm - 1) < 1e-6) edit.flux_lm.reset();
  }
  editor_.edit(city.scene, *city.on_device, light, edit);
  const render::RenderSettings& settings = session_.state.settings;
  find_lights(*picked, city.scene, settings.time_s, settings.environment.lights);
}

void Controller::run(const std::function<std::string()>& errand) {
  try {
    const std::string sentence = errand();
    session_.notices.say(sentence, now_s_);
    spdlog::info("{}", sentence);
  } catch (const Error& error) {
    session_.notices.say(error.what(), now_s_, true);
  }
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

void Controller::save_edits() {
  run([this] { return editor_.save(); });
}

void Controller::toggle_recording() {
  run([this] { return recorder_.toggle(scene::find_scene_file(workbench_.city().path), now_s_); });
}

void Controller::save_settings() {
  run([this] { return viewer::save_settings(options_.settings_file, session_.state); });
}

void Controller::save() {
  if (workbench_.is_saving() || !workbench_.has_city()) {
    session_.notices.say("a picture is being saved already", now_s_);
    return;
  }
  workbench_.save(views().view, options_.picture);
}

void Controller::finish_saving() {
  try {
    const std::string sentence =
        save_picture(find_picture_folder(options_.picture_folder),
                     workbench_.take_saved(session_.state.settings.display));
    session_.notices.say(sentence, now_s_);
    spdlog::info("{}", sentence);
  } catch (const std::exception& error) {  // a full disk is no reason to close the window
    session_.notices.say(fmt::format("the picture is not saved: {}", error.what()), now_s_, true);
    spdlog::error("{}", error.what());
  }
}

}  // namespace nightcity::viewer
