// nightview flight SCENE.glb --path PATH --out DIR: error and cost of every frame of a moving camera.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/png.h"
#include "runtime/measure/table.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/experiment.h"
#include "runtime/nightview/render_options.h"
#include "runtime/scene/camera_path.h"

namespace nightcity {
namespace {

struct FlightCommand {
  RenderOptions options;
  std::string folder, path = "orbit";
  std::uint32_t frames = 120, every = 1, reference_frames = 16;
  double firefly_budget = 1e-4;
  std::optional<float> ev100;
  bool pictures = false;
};

void show_progress(std::uint32_t done, std::uint32_t all) {
  if (!isatty(STDERR_FILENO)) return;
  fmt::print(stderr, "\rframe {}/{} {}", done, all, done == all ? "\n" : "");
  std::fflush(stderr);
}

std::string summary(const char* what, const char* unit, const std::vector<double>& values) {
  const auto worst = std::max_element(values.begin(), values.end());
  const double middle = median(values);
  return fmt::format("{:<14} median {:.4g}{}, worst {:.4g}{} ({:.2f} x) in measured frame {}\n",
                     what, middle, unit, *worst, unit, middle > 0 ? *worst / middle : 1.0,
                     worst - values.begin());
}

void fly(FlightCommand& command) {
  RenderOptions& options = command.options;
  options.resolve();
  options.settings.jitter = false;  // as the reference has it: edges are not what is measured
  Experiment experiment(load_render_scene(options.scene),
                        {options.device, options.width, options.height});
  const CameraPath path = find_path(command.path, experiment.scene());
  const std::filesystem::path folder = command.folder;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (!std::filesystem::is_directory(folder))
    throw Error(command.folder, "is not a folder that can be written to");

  experiment.warm_up(path.at(0), options.settings);

  Table table{{"frame", "x", "y", "z", "ms", "rmse8", "relative_mse", "relative_mean_signed_error",
               "fireflies"},
              {}};
  std::vector<double> ms, rmse8, relative_mse, fireflies;
  for (std::uint32_t i = 0; i < command.frames; ++i) {
    const CameraPose pose = path.at(command.frames > 1 ? double(i) / (command.frames - 1) : 0.0);
    experiment.renderer().render_frame(pose, options.settings);
    const double frame_ms = gpu_ms(experiment.renderer());
    std::vector<std::string> row{fmt::to_string(i), fmt::format("{:.3f}", pose.position.x),
                                 fmt::format("{:.3f}", pose.position.y),
                                 fmt::format("{:.3f}", pose.position.z),
                                 fmt::format("{:.4g}", frame_ms)};
    // The first frame has no history and the driver compiles in it: it belongs to no flight.
    if (i > 0) ms.push_back(frame_ms);
    const Image picture = experiment.renderer().download(false);
    if (i > 0 && i % command.every == 0) {
      const Image truth =
          experiment.reference(pose, options.settings, command.reference_frames, {});
      const Comparison c = compare(picture, truth);
      for (const double value :
           {c.rmse8, c.relative_mse, c.relative_mean_signed_error, c.fireflies})
        row.push_back(fmt::format("{:.5g}", value));
      rmse8.push_back(c.rmse8);
      relative_mse.push_back(c.relative_mse);
      fireflies.push_back(c.fireflies);
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
    if (command.pictures) {
      if (!command.ev100)
        command.ev100 = auto_exposure_ev100(picture);  // one exposure for the whole flight
      write_png(folder / fmt::format("frame-{:04}.png", i), to_display(picture, *command.ev100),
                png_text(picture.info));
    }
    show_progress(i + 1, command.frames);
  }
  experiment.check_validation();
  write_csv(folder / "flight.csv", table);

  fmt::print("{} frames of {} along {}, {} on {}\n", command.frames, options.scene, command.path,
             name_of(options.settings.estimator), experiment.device_name());
  if (!ms.empty()) fmt::print("{}", summary("time", " ms", ms));
  if (rmse8.empty()) return;
  fmt::print("{}{}", summary("RMSE (8-bit)", "", rmse8), summary("relative MSE", "", relative_mse));
  const double most = *std::max_element(fireflies.begin(), fireflies.end());
  fmt::print(
      "fireflies      {:.4f} % of the pixels in the worst frame: {} the budget of {:.4f} %\n",
      100 * most, most <= command.firefly_budget ? "within" : "OVER", 100 * command.firefly_budget);
}

}  // namespace

void add_flight_command(CLI::App& app) {
  auto command = std::make_shared<FlightCommand>();
  CLI::App* sub =
      app.add_subcommand("flight", "Error and milliseconds of every frame of a moving camera");
  std::string presets;
  for (const std::string& name : path_presets()) presets += (presets.empty() ? "" : ", ") + name;
  sub->footer(
      "DIR gets flight.csv and, with --pictures, frame-NNNN.png. Each measured frame is compared "
      "with a "
      "reference of its "
      "own view.\n"
      "Examples:\n"
      "  nightview flight city.glb --path dive --frames 240 --size 320x180 --out flight\n"
      "  nightview flight city.glb --path path.json --every 10 --pictures --out flight");
  command->options.size = "320x180";
  command->options.declare(*sub);
  sub->add_option("-o,--out", command->folder, "Folder of the results")->required();
  sub->add_option("--path", command->path, "File {\"poses\": [camera, ...]} or preset: " + presets)
      ->capture_default_str();
  sub->add_option("--frames", command->frames, "Frames along the path")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->add_option("--every", command->every, "Measure the error of every so manieth frame")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->add_option("--reference-frames", command->reference_frames,
                  "Frames of each reference picture")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->add_option("--firefly-budget", command->firefly_budget,
                  "Share of a frame's pixels that may be fireflies")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  sub->add_option("--ev", command->ev100,
                  "Exposure of the pictures, EV100 (default: metered from the first)");
  sub->add_flag("--pictures", command->pictures, "Write every frame as PNG");
  sub->callback([command] { fly(*command); });
}

}  // namespace nightcity
