// nightview vehicles: what a frame costs against the number of vehicles that move in it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "formats/program/number_check.h"
#include "runtime/experiments/vehicles.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"

namespace nightcity::nightview {
namespace {

struct VehiclesCommand {
  experiments::VehiclesOptions options;
  render::RenderSettings settings;
  std::string size = "1280x720", vehicles = "0,100,1000,10000";
};

void time_traffic(VehiclesCommand& command) {
  experiments::VehiclesOptions& options = command.options;
  const render::PictureSize size = render::parse_size(command.size);
  options.width = size.width;
  options.height = size.height;
  options.estimator = command.settings.sampling.estimator;
  options.vehicles = render::parse_counts("--vehicles", command.vehicles, 0, 1'000'000);
  fmt::print("{}", measure::to_markdown(time_vehicles(options)));
}

}  // namespace

void add_vehicles_command(CLI::App& app) {
  auto command = std::make_shared<VehiclesCommand>();
  experiments::VehiclesOptions& options = command->options;
  CLI::App* sub =
      app.add_subcommand("vehicles", "Time a frame against the number of moving vehicles")
          ->alias("fleet");
  sub->footer(
      "Renders synthetic streets with lamps and each number of vehicles, all driving: bodies with "
      "four\n"
      "lights each, and the BVHs over both built for every frame, --time-step apart. Prints "
      "medians "
      "by the\n"
      "device's clock.\n"
      "Example:\n  nightview vehicles --vehicles 0,1000,10000 --size 1920x1080 --estimator traced");
  declare_size(*sub, command->size);
  declare_setting(*sub, render::list_settings().front(), command->settings);
  declare_device(*sub, options.device);
  sub->add_option("--vehicles", command->vehicles, "Numbers of vehicles, comma-separated")
      ->capture_default_str();
  sub->add_option("--lamps", options.lamps, "Street lamps: the size of the field")
      ->capture_default_str()
      ->check(program::count_from(1, 10'000'000));
  sub->add_option("--frames", options.frames, "Frames timed")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub->add_option("--time-step", options.time_step_s,
                  "Seconds by which the clock moves on before every frame; 0 = it stands still")
      ->capture_default_str()
      ->check(program::number_from(0, 3600));
  sub->callback([command] { time_traffic(*command); });
}

}  // namespace nightcity::nightview
