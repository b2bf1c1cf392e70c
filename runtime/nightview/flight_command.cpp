// nightview flight SCENE.glb --path PATH --out DIR: error and cost of every frame of a moving
// camera.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numeric>

#include "formats/median.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "runtime/experiments/flight.h"
#include "runtime/measure/significance.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/governor_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::nightview {
namespace {

struct FlightCommand {
  RenderOptions render;
  experiments::FlightOptions flight;
  double firefly_budget = 1e-4;
};

std::string summarise(const char* what, const char* unit, const std::vector<double>& values) {
  const auto worst = std::max_element(values.begin(), values.end());
  const double middle = median(values);
  return fmt::format("{:<14} median {:.4g}{}, worst {:.4g}{} ({:.2f} x) in measured frame {}\n",
                     what, middle, unit, *worst, unit, middle > 0 ? *worst / middle : 1.0,
                     worst - values.begin());
}

std::string summarise_bias(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  return fmt::format(
      "mean error     {:+.4f} % +- {:.4f} % of the reference's mean, over {} frames\n", 100 * mean,
      100 * measure::find_series_error(values), values.size());
}

void print_governed(const FlightCommand& command, const experiments::FlightReport& report) {
  const double budget = command.flight.governor.budget_ms;
  if (budget > 0 && !report.ms.empty()) {
    const auto within = std::count_if(report.ms.begin(), report.ms.end(),
                                      [budget](double ms) { return ms <= budget; });
    fmt::print("budget         {:g} ms kept in {:.2f} % of the frames\n", budget,
               100 * double(within) / double(report.ms.size()));
  }
  fmt::print("setting        {} at the end, {} changes\n",
             report.governor->rungs()[report.governor->rung()].name(),
             report.governor->decisions().size());
}

void print_report(const FlightCommand& command, const experiments::FlightReport& report) {
  fmt::print("{} frames of {} along {}, {} on {}\n", command.flight.frames, command.render.scene,
             command.flight.path, render::name_of(command.render.settings.sampling.estimator),
             report.device);
  if (!report.ms.empty()) fmt::print("{}", summarise("time", " ms", report.ms));
  if (report.governor) print_governed(command, report);
  if (report.rmse8.empty()) return;
  fmt::print("{}{}{}", summarise("RMSE (8-bit)", "", report.rmse8),
             summarise("relative MSE", "", report.relative_mse),
             summarise_bias(report.mean_signed_error));
  const double worst = *std::max_element(report.fireflies.begin(), report.fireflies.end());
  fmt::print(
      "fireflies      {:.4f} % of the pixels in the worst frame: {} the budget of {:.4f} %\n",
      100 * worst, worst <= command.firefly_budget ? "within" : "OVER",
      100 * command.firefly_budget);
}

void run_flight(FlightCommand& command) {
  RenderOptions& render = command.render;
  render.resolve();
  experiments::Experiment experiment(render.load(), {render.device, render.width, render.height});
  program::ProgressDisplay progress;
  const auto report = fly(command.flight, experiment, render.settings, progress);
  progress.clear();
  print_report(command, report);
}

}  // namespace

void add_flight_command(CLI::App& app) {
  auto command = std::make_shared<FlightCommand>();
  experiments::FlightOptions& flight = command->flight;
  CLI::App* sub = app.add_subcommand(
      "flight", "Measure error and milliseconds of every frame of a moving camera");
  std::string presets;
  for (const std::string& name : scene::path_presets())
    presets += (presets.empty() ? "" : ", ") + name;
  sub->footer(
      "DIR gets flight.csv and, with --pictures, frame-NNNN.png. Each measured frame is compared "
      "with a\n"
      "reference of its own view.\n"
      "Examples:\n"
      "  nightview flight city.glb --path dive --frames 240 --size 320x180 --out flight\n"
      "  nightview flight city.glb --path street --time 18:30 --time-step 0.0333 --out flight\n"
      "  nightview flight city.glb --path orbit --budget-ms 16 --reference-frames 1 --every 30 "
      "--out flight\n"
      "  nightview flight city.glb --path path.json --every 10 --pictures --out flight");
  command->render.size = "320x180";
  command->render.declare(*sub);
  program::add_output_option(*sub, flight.folder, "Folder of the results")->required();
  sub->add_option("--path", flight.path, "File {\"poses\": [camera, ...]} or preset: " + presets)
      ->capture_default_str();
  sub->add_option("--frames", flight.frames, "Frames along the path")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub->add_option("--time-step", flight.time_step_s,
                  "Seconds by which the clock moves on before every frame; 0 = it stands still")
      ->capture_default_str()
      ->check(program::number_from(0, 3600));
  sub->add_option("--every", flight.every, "Measure the error of every Nth frame")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub->add_option("--reference-frames", flight.reference_frames, "Frames of each reference picture")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  declare_governor(*sub, flight.governor);
  sub->add_option("--firefly-budget", command->firefly_budget,
                  "Share of a frame's pixels that may be fireflies")
      ->capture_default_str()
      ->check(program::number_from(0, 1));
  sub->add_option("--ev", flight.ev100,
                  "Exposure of the pictures, EV100 (default: metered from the first)")
      ->check(program::number_from(-20, 40));
  sub->add_flag("--pictures", flight.pictures, "Write every frame as PNG");
  sub->callback([command] { run_flight(*command); });
}

}  // namespace nightcity::nightview
