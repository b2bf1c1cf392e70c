// nightview strategies --out DIR: which source of candidates is worth its time at which number of
// lights.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "runtime/experiments/strategies.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"

namespace nightcity::nightview {
namespace {

struct StrategiesCommand {
  experiments::StrategiesOptions options;
  std::string size = "320x180", lights = "10,1000,100000,1000000";
};

void compare_sources(StrategiesCommand& command) {
  experiments::StrategiesOptions& options = command.options;
  const render::PictureSize size = render::parse_size(command.size);
  options.width = size.width;
  options.height = size.height;
  options.lights = render::parse_counts("--lights", command.lights, 1, 10'000'000);
  fmt::print("{}", measure::to_markdown(compare_strategies(options)));
}

}  // namespace

void add_strategies_command(CLI::App& app) {
  auto command = std::make_shared<StrategiesCommand>();
  experiments::StrategiesOptions& options = command->options;
  CLI::App* sub = app.add_subcommand(
      "strategies", "Compare the sources of light candidates against the number of lights");
  sub->footer(
      "Renders synthetic streets with each number of lamps, with equally many candidates from each "
      "source,\n"
      "and prints a table; DIR gets it as strategies.csv.\n"
      "Example:\n  nightview strategies --out strategies --lights 10,1000 --size 96x54");
  program::add_output_option(*sub, options.folder, "Folder of the results")->required();
  sub->add_option("--lights", command->lights, "Numbers of lamps, comma-separated")
      ->capture_default_str();
  declare_size(*sub, command->size);
  sub->add_option("--candidates", options.candidates, "Light candidates per pixel and frame")
      ->capture_default_str()
      ->check(program::count_from(1, render::max_candidates));
  sub->add_option("--frames", options.frames, "Frames whose mean is measured")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub->add_option("--reference-frames", options.reference_frames,
                  "Frames of each reference picture")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  declare_device(*sub, options.device);
  sub->callback([command] { compare_sources(*command); });
}

}  // namespace nightcity::nightview
