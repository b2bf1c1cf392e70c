// nightview view SCENE.glb: shows the scene in a window.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "runtime/measure/exposure.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/governor_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"
#include "runtime/viewer/comparison.h"
#include "runtime/viewer/keys.h"
#include "runtime/viewer/viewer.h"
#include "runtime/viewer/views.h"
#include "runtime/viewer/window_settings.h"

namespace nightcity::nightview {
namespace {

struct ViewCommand {
  RenderOptions render;
  viewer::ViewOptions view;
  std::string exposure = "auto", tone = "filmic", show = "picture", compare, picture_size;
};

// Runs before the window opens: a wrong name should not be found out when it closes.
void check_outputs(const viewer::ViewOptions& options) {
  if (!options.screenshot.empty() && options.quit_after == 0)
    throw UsageError("--screenshot",
                     "needs --quit-after: it is of the last frame before that (P saves a picture "
                     "at any time)");
  if (!options.screenshot.empty()) program::require_writable_folder_of(options.screenshot);
  if (!options.save_camera.empty()) program::require_writable_folder_of(options.save_camera);
  if (!options.picture_folder.empty()) program::require_writable_folder(options.picture_folder);
}

// Returns the first words of the command with which the window films: this program, on the same
// device, with the same parts of the model and the same sky map.
std::vector<std::string> make_record_command(const RenderOptions& render) {
  std::vector<std::string> words{"/proc/self/exe", "record"};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) words.push_back(std::string(name) + "=" + value);
  };
  add("--device", render.device.select);
  add("--trace", gpu::name_of(render.device.trace));
  add("--leave-out", render.leave_out);
  add("--sky-map", render.sky_map);
  return words;
}

void view(ViewCommand& command) {
  RenderOptions& render = command.render;
  render.to_be_looked_at = true;
  render.resolve();
  if (!render.settings_file.empty()) {
    const render::SettingsFile file = render::read_settings_file(render.settings_file);
    if (const std::string show = viewer::find_window_value(file, "show");
        !show.empty() && command.show == "picture")
      command.show = show;
    if (const std::string every = viewer::find_window_value(file, "every");
        !every.empty() && command.view.divisor == 0)
      command.view.divisor = viewer::parse_divisor(every);
  }
  render.settings.display.tone = measure::tone_curve_from_name(command.tone);
  viewer::show_view(viewer::find_view(command.show), render.settings.display);
  viewer::ViewOptions& options = command.view;
  if (!command.compare.empty() && render.settings.display.view == VIEW_DIFFERENCE)
    throw UsageError("--compare", "is another comparison than --show difference: give one of them");
  if (!command.compare.empty())
    options.compared = viewer::change_settings(render.settings, command.compare);
  options.scenes.insert(options.scenes.begin(), render.scene);
  options.load = [&render](const std::string& scene, const scene::TakeTraits& take) {
    return render.load(scene, take);
  };
  options.camera = render.camera;
  options.device = render.device;
  options.width = render.width;
  options.height = render.height;
  options.settings = render.settings;
  options.settings_file = render.settings_file;
  options.record_command = make_record_command(render);
  options.edits = render.edits;
  options.ev100 = render::parse_exposure(command.exposure);
  if (!command.picture_size.empty()) {
    const render::PictureSize size = render::parse_size(command.picture_size);
    options.picture.width = size.width;
    options.picture.height = size.height;
  }
  check_outputs(options);
  const viewer::ViewReport report = viewer::run_viewer(options);
  fmt::print("{} frames shown, the last {} of them averaged, estimator {}\n", report.shown,
             report.frames, report.estimator);
  if (!report.intervals.empty()) fmt::print("between pictures in motion: {}\n", report.intervals);
  if (!report.pace.empty()) fmt::print("budget: {}\n", report.pace);
  // All is done and kept. A caller learns all the same that the window was closed by a signal: a
  // shell that saw the exit code 0 after Ctrl-C would go on with its loop. Results that cannot be
  // written are an error first.
  if (report.closing_signal != 0 && std::fflush(stdout) == 0) std::raise(report.closing_signal);
}

std::string describe_input() {
  std::string text = "Mouse:\n";
  for (const auto& [gesture, effect] : viewer::list_gestures())
    text += fmt::format("  {:22} {}\n", gesture, effect);
  text += "Keys:\n";
  for (const viewer::KeyBinding& key : viewer::list_keys())
    text += fmt::format("  {:22} {}\n", key.keys, key.help);
  return text + "Example: nightview view out/demo/city.glb --camera street";
}

void declare_pictures(CLI::App& sub, ViewCommand& command) {
  viewer::ViewOptions& view = command.view;
  sub.add_option("--picture-size", command.picture_size,
                 "Size of saved pictures, WIDTHxHEIGHT (default: the window's)");
  sub.add_option("--picture-frames", view.picture.frames, "Frames averaged in a saved picture")
      ->capture_default_str()
      ->check(program::count_from(1, 1000000));
  sub.add_option("--picture-folder", view.picture_folder,
                 "Folder of saved pictures (default: the current one, or where that takes no "
                 "files, the pictures' or home folder)");
  sub.add_option("--screenshot", view.screenshot,
                 "With --quit-after: write the window's last frame to this PNG, with the panel");
  sub.add_option("--save-camera", view.save_camera, "Write the last camera to a JSON file");
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto command = std::make_shared<ViewCommand>();
  CLI::App* sub = app.add_subcommand(
      "view", "Show a baked scene in a window; \"nightview SCENE.glb\" is short for it");
  sub->footer(describe_input());
  command->render.settings.indirect.bounces = render::picture_bounces;
  command->render.declare(*sub);
  viewer::ViewOptions& view_options = command->view;
  sub->add_option("others", view_options.scenes, "Further scenes, to choose from in the panel");
  sub->add_option("--ev", command->exposure,
                  "Exposure, EV100, or 'auto': metered from the picture again and again")
      ->capture_default_str();
  sub->add_option("--tone", command->tone, "Tone curve: filmic, reinhard or linear")
      ->capture_default_str();
  sub->add_option("--show", command->show,
                  "What is shown at first: picture, wireframe, or in false colours luminance, "
                  "illuminance, direct-illuminance, indirect-illuminance, kinds-of-light, "
                  "city-objects, tiles, history, noise or difference (to the reference)")
      ->capture_default_str();
  sub->add_option("--compare", command->compare,
                  "Show a picture of other settings left of a line that the mouse drags: "
                  "NAME=VALUE,... such as estimator=ris,time=23:00")
      ->default_str("none");
  sub->add_option("--frames", view_options.max_frames,
                  "Frames that are averaged while nothing changes")
      ->capture_default_str()
      ->check(program::count_from(1, 1000000));
  sub->add_option("--every", view_options.divisor,
                  "Render every Nth pixel along each side of the window: 1, 2, 4 or 8; 0: coarse "
                  "while the view moves, then finer until every pixel is there")
      ->capture_default_str()
      ->check(program::count_from(0, 8))
      ->check(CLI::IsMember({0, 1, 2, 4, 8}));
  declare_governor(*sub, view_options.governor);
  sub->add_option("--font-size", view_options.font_px,
                  "Height of the window's text in pixels, 8 to 64; 0: as the screen's scale asks "
                  "for")
      ->capture_default_str()
      ->check(program::number_from(0, 64));
  sub->add_flag("--markers", view_options.markers, "Start with lamp markers drawn");
  sub->add_flag("--play", view_options.play, "Start with the clock running");
  sub->add_option(
         "--time-step", view_options.time_step_s,
         "Seconds by which the running clock moves on with every picture; 0 = it keeps real "
         "time, at the speed set in the panel")
      ->capture_default_str()
      ->check(program::number_from(0, 3600));
  sub->add_flag("--offscreen", view_options.offscreen,
                "Draw into memory and leave the window black: measures frames where the driver "
                "cannot show them, as on a virtual screen");
  sub->add_option("--quit-after", view_options.quit_after, "Close after showing this many pictures")
      ->check(program::count_from(0, 0xFFFFFFFF));
  declare_pictures(*sub, *command);
  sub->callback([command] { view(*command); });
}

}  // namespace nightcity::nightview
