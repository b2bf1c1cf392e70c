// nightview fleet: what a frame costs against the number of vehicles that move in it.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <map>
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

struct FleetCommand {
  gpu::Device::Options device;
  std::string size = "1280x720", estimator = name_of(RenderSettings{}.estimator);
  std::string vehicles = "0,100,1000,10000";
  std::size_t lamps = 10'000;
  std::uint32_t frames = 32;
};

constexpr double frame_s = 1.0 / 60;

void measure_fleets(FleetCommand& command) {
  RenderOptions size;
  size.size = command.size;
  size.resolve();
  RenderSettings settings;
  settings.estimator = estimator_from_name(command.estimator);
  std::vector<std::string> fleet_passes{"fleet poses", "fleet tree"};
  if (command.device.trace != gpu::Trace::compute) fleet_passes.push_back("top level");
  Table table{{"vehicles", "lights", "ms"}, {}};
  for (const std::string& pass : fleet_passes) table.columns.push_back(pass + ", ms");
  table.columns.push_back("others, ms");
  for (const std::string& word : split_list("--vehicles", command.vehicles)) {
    const std::size_t vehicles = count_of("--vehicles", word, 0, 1'000'000);
    Experiment experiment(lamp_field(command.lamps, vehicles),
                          {command.device, size.width, size.height});
    spdlog::info("{} vehicles on {}", vehicles, experiment.device_name());
    Renderer& renderer = experiment.renderer();
    std::map<std::string, std::vector<double>> passes;
    std::vector<double> all;
    constexpr std::uint32_t warm_up = 4;
    settings.time_s = 8 * 3600;
    experiment.warm_up(lamp_field_camera(), settings);
    for (std::uint32_t i = 0; i < command.frames + warm_up; ++i) {
      settings.time_s = 8 * 3600 + 10 + frame_s * i;
      renderer.render_frame(lamp_field_camera(), settings);
      if (i < warm_up) continue;
      std::map<std::string, double> frame;
      for (const auto& span : renderer.timings()) frame[span.name] += span.ms;
      for (const auto& [name, ms] : frame) passes[name].push_back(ms);
      all.push_back(gpu_ms(renderer));
    }
    experiment.check_validation();
    double others = median(all);
    std::vector<std::string> row{
        fmt::to_string(vehicles),
        fmt::to_string(experiment.scene().lights.size() +
                       vehicles * experiment.scene().traffic.vehicle_lights.size()),
        fmt::format("{:.3g}", others)};
    for (const std::string& pass : fleet_passes) {
      const double ms = passes.count(pass) ? median(passes[pass]) : 0;
      others -= ms;
      row.push_back(fmt::format("{:.3g}", ms));
    }
    row.push_back(fmt::format("{:.3g}", others));
    table.rows.push_back(std::move(row));
  }
  fmt::print("{}", to_markdown(table));
}

}  // namespace

void add_fleet_command(CLI::App& app) {
  auto command = std::make_shared<FleetCommand>();
  CLI::App* sub =
      app.add_subcommand("fleet", "Cost of a frame against the number of moving vehicles");
  sub->footer(
      "Synthetic streets with lamps and so many vehicles, all driving: bodies, four lights each, "
      "the trees "
      "over both built "
      "anew\nfor every frame, 1/60 s apart. Medians by the device's clock.\n"
      "Example:\n  nightview fleet --vehicles 0,1000,10000 --size 1920x1080 --estimator traced");
  sub->add_option("--size", command->size, "Picture size in pixels, WIDTHxHEIGHT")
      ->capture_default_str();
  sub->add_option("--estimator", command->estimator, "As of nightview render")
      ->capture_default_str();
  declare_device(*sub, command->device);
  sub->add_option("--vehicles", command->vehicles, "Numbers of vehicles")->capture_default_str();
  sub->add_option("--lamps", command->lamps, "Street lamps: the size of the field")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t(1), std::size_t(10'000'000)));
  sub->add_option("--frames", command->frames, "Frames timed")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->callback([command] { measure_fleets(*command); });
}

}  // namespace nightcity
