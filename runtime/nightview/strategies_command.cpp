// nightview strategies --out DIR: which source of candidates is worth its time at which number of lights.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>

#include "formats/error.h"
#include "runtime/measure/table.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/experiment.h"
#include "runtime/nightview/knobs.h"
#include "runtime/nightview/lamp_field.h"
#include "runtime/nightview/render_options.h"

namespace nightcity {
namespace {

struct StrategiesCommand {
  gpu::Device::Options device;
  std::string folder, size = "320x180", lights = "10,1000,100000,1000000";
  std::uint32_t candidates = 32, reference_frames = 8, frames = 16;
};

struct Strategy {
  const char* name;
  float local_share, wide_share, uniform_share;  // the rest by flux
};

// Every mixture but the first two keeps a share over all lights: a cell lists its strongest only.
constexpr std::array strategies{
    Strategy{"uniform", 0, 0, 1},
    Strategy{"power", 0, 0, 0},
    Strategy{"half uniform, half power", 0, 0, 0.5f},
    Strategy{"local 0.9, power 0.1", 0.9f, 0, 0},
    Strategy{"local 0.7, uniform 0.1, power 0.2", 0.7f, 0, 0.1f},
    Strategy{"wide 0.8, uniform 0.05, power 0.15", 0, 0.8f, 0.05f},
    Strategy{"local 0.7, wide 0.2, uniform 0.05, power 0.05", 0.7f, 0.2f, 0.05f},
    Strategy{"local 0.5, wide 0.3, uniform 0.05, power 0.15", 0.5f, 0.3f, 0.05f}};

void compare_strategies(const StrategiesCommand& command) {
  RenderOptions size;
  size.size = command.size;
  size.resolve();
  std::vector<std::size_t> counts;
  for (const std::string& word : split_list("--lights", command.lights))
    counts.push_back(count_of("--lights", word, 1, 10'000'000));
  const std::filesystem::path folder = command.folder;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (!std::filesystem::is_directory(folder))
    throw Error(command.folder, "is not a folder that can be written to");

  Table table{{"lights", "estimator", "candidates from", "ms", "relative MSE of a frame",
               fmt::format("of the mean of {}", command.frames), "mean error, %"},
              {}};
  for (const std::size_t count : counts) {
    Experiment experiment(lamp_field(count), {command.device, size.width, size.height});
    spdlog::info("{} lights, {} triangles on {}: reference", count,
                 experiment.scene().triangles.size(), experiment.device_name());
    RenderSettings settings;
    settings.jitter = false;
    settings.candidates = command.candidates;
    const CameraPose pose = lamp_field_camera();
    const Image truth =
        experiment.reference(pose, settings, command.reference_frames,
                             folder / fmt::format("reference-{}-{}.exr", count, command.size));
    for (const Estimator estimator : {Estimator::ris, RenderSettings{}.estimator})
      for (const Strategy& strategy : strategies) {
        settings.estimator = estimator;
        settings.local_share = strategy.local_share;
        settings.wide_share = strategy.wide_share;
        settings.uniform_share = strategy.uniform_share;
        const auto counts_of_frames =
            command.frames > 1 ? std::vector{1u, command.frames} : std::vector{1u};
        const auto m = experiment.measure(pose, settings, truth, counts_of_frames, 8, 1);
        table.rows.push_back({fmt::to_string(count), name_of(estimator), strategy.name,
                              fmt::format("{:.3g}", m.back().ms),
                              fmt::format("{:.3g}", m.front().relative_mse),
                              fmt::format("{:.3g}", m.back().relative_mse),
                              fmt::format("{:+.2f}", 100 * m.back().relative_mean_signed_error)});
        write_csv(folder / "strategies.csv", table);
      }
    experiment.check_validation();
  }
  fmt::print("{}", to_markdown(table));
}

}  // namespace

void add_strategies_command(CLI::App& app) {
  auto command = std::make_shared<StrategiesCommand>();
  CLI::App* sub =
      app.add_subcommand("strategies", "Sources of light candidates against the number of lights");
  sub->footer(
      "Renders synthetic streets with so many lamps, an equal number of candidates from each "
      "source, and "
      "prints a table; "
      "DIR\ngets it as strategies.csv.\n"
      "Example:\n  nightview strategies --out strategies --lights 10,1000 --size 96x54");
  sub->add_option("-o,--out", command->folder, "Folder of the results")->required();
  sub->add_option("--lights", command->lights, "Numbers of lamps")->capture_default_str();
  sub->add_option("--size", command->size, "Picture size in pixels, WIDTHxHEIGHT")
      ->capture_default_str();
  sub->add_option("--candidates", command->candidates, "Light candidates a pixel and frame")
      ->capture_default_str()
      ->check(CLI::Range(1u, max_candidates));
  sub->add_option("--frames", command->frames, "Frames whose mean is measured")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->add_option("--reference-frames", command->reference_frames,
                  "Frames of each reference picture")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  declare_device(*sub, command->device);
  sub->callback([command] { compare_strategies(*command); });
}

}  // namespace nightcity
