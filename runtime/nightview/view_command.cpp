// nightview view SCENE.glb: shows the scene in a window.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "runtime/measure/exposure.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/number_check.h"
#include "runtime/nightview/render_options.h"
#include "runtime/viewer/viewer.h"

namespace nightcity::nightview {
namespace {

struct ViewCommand {
  RenderOptions render;
  viewer::ViewOptions view;
  std::string tone = "filmic";
};

void view(ViewCommand& command) {
  RenderOptions& render = command.render;
  render.resolve();
  render.settings.display.tone = measure::tone_curve_from_name(command.tone);
  viewer::ViewOptions& options = command.view;
  options.scene = render.scene;
  options.camera = render.camera;
  options.device = render.device;
  options.width = render.width;
  options.height = render.height;
  options.settings = render.settings;
  const viewer::ViewReport report = viewer::run_viewer(render.load(), options);
  fmt::print("{} frames shown, the last {} of them averaged, estimator {}\n", report.shown,
             report.frames, report.estimator);
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto command = std::make_shared<ViewCommand>();
  CLI::App* sub = app.add_subcommand(
      "view", "Show a baked scene in a window; \"nightview SCENE.glb\" is short for it");
  sub->footer(
      "Mouse: the left button orbits or looks around, the right button moves, the wheel comes "
      "nearer\n"
      "(when flying: changes the speed).\n"
      "Keys: W A S D E Q fly, with Shift faster; 1 to " +
      std::to_string(render::list_estimators().size()) +
      " choose the estimator; M shows lamp markers;\n"
      "F switches between orbiting and flying; Space starts and stops the clock; P saves the "
      "picture as\n"
      "night-NNN.png and .exr; Tab shows or hides the panel; Esc quits.\n"
      "Example: nightview view out/demo/city.glb --camera street");
  command->render.declare(*sub);
  sub->add_option("--ev", command->view.ev100,
                  "Exposure, EV100 (default: metered from the picture again and again)")
      ->check(exposure_check());
  sub->add_option("--tone", command->tone, "Tone curve: filmic, reinhard or linear")
      ->capture_default_str();
  sub->add_option("--frames", command->view.max_frames,
                  "Frames that are averaged while nothing changes")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000000u));
  sub->add_option(
         "--every", command->view.divisor,
         "Render every Nth pixel along each side of the window: 1, 2, 4 or 8; 0 chooses by "
         "the device's speed")
      ->capture_default_str()
      ->check(CLI::IsMember({0, 1, 2, 4, 8}));
  sub->add_flag("--markers", command->view.markers, "Start with lamp markers drawn");
  sub->add_flag("--play", command->view.play, "Start with the clock running");
  sub->add_option("--time-step", command->view.time_step_s,
                  "Seconds by which the running clock moves on in every frame; 0 = it keeps real "
                  "time, at the speed set in the panel")
      ->capture_default_str()
      ->check(number_from(0, 3600));
  sub->add_option("--quit-after", command->view.quit_after, "Close after showing this many frames");
  sub->add_option("--screenshot", command->view.screenshot,
                  "With --quit-after: write the window's last frame to this PNG, with the panel");
  sub->add_option("--save-camera", command->view.save_camera,
                  "Write the last camera to a JSON file");
  sub->callback([command] { view(*command); });
}

}  // namespace nightcity::nightview
