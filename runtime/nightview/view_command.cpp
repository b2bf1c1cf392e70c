// nightview SCENE.glb: a window on the scene.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "runtime/measure/exposure.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/render_options.h"
#include "runtime/viewer/viewer.h"

namespace nightcity {
namespace {

struct ViewCommand {
  RenderOptions render;
  ViewOptions view;
  std::string tone = "filmic";
};

void view(ViewCommand& command) {
  RenderOptions& render = command.render;
  render.resolve();
  render.settings.tone = tone_curve_from_name(command.tone);
  ViewOptions& options = command.view;
  options.scene = render.scene;
  options.camera = render.camera;
  options.device = render.device;
  options.width = render.width;
  options.height = render.height;
  options.settings = render.settings;
  const ViewReport report = run_viewer(render.load(), options);
  fmt::print("{} frames shown, the last {} of them averaged, estimator {}\n", report.shown,
             report.frames, report.estimator);
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto command = std::make_shared<ViewCommand>();
  CLI::App* sub = app.add_subcommand(
      "view", "Open a window on a baked scene; \"nightview SCENE.glb\" is short for it");
  sub->footer(
      "Mouse: left button orbits or looks round, right button moves, wheel comes nearer (flying: "
      "faster).\n"
      "Keys: W A S D E Q fly, Shift faster; 1 to 6 estimator; M lamp markers; F orbit or fly; "
      "Space lets the "
      "clock run;\n"
      "P saves the picture as night-NNN.png and .exr; Tab panel; Esc quits.");
  command->render.declare(*sub);
  sub->add_option("--ev", command->view.ev100,
                  "Exposure, EV100 (default: metered as the picture goes)")
      ->check(CLI::Range(-20.0f, 40.0f));
  sub->add_option("--tone", command->tone, "Tone curve: filmic, reinhard or linear")
      ->capture_default_str();
  sub->add_option("--frames", command->view.max_frames,
                  "Frames that are averaged while nothing changes")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000000u));
  sub->add_option("--every", command->view.divisor,
                  "Render every Nth pixel along each side of the window: 1, 2, 4, 8, or 0: as many "
                  "as are quick")
      ->capture_default_str()
      ->check(CLI::IsMember({0, 1, 2, 4, 8}));
  sub->add_flag("--markers", command->view.markers, "Start with lamp markers drawn");
  sub->add_flag("--play", command->view.play, "Start with the clock running");
  sub->add_option("--quit-after", command->view.quit_after, "Close after showing this many frames");
  sub->add_option("--screenshot", command->view.screenshot,
                  "With --quit-after: PNG of the window's last frame, panel and all");
  sub->add_option("--save-camera", command->view.save_camera,
                  "Write the last camera to a JSON file");
  sub->callback([command] { view(*command); });
}

}  // namespace nightcity
