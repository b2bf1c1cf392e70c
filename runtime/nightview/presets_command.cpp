// nightview presets: lists the presets, or makes them anew from a sweep.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "runtime/experiments/pick_presets.h"
#include "runtime/measure/table.h"
#include "runtime/nightview/commands.h"
#include "runtime/render/presets.h"

namespace nightcity::nightview {
namespace {

struct PresetsCommand {
  std::string from, device_class = "gpu";
};

void list_all() {
  measure::Table table{{"device", "preset", "settings"}, {}};
  for (const render::Preset& preset : render::list_presets())
    table.rows.push_back({preset.device_class, preset.name, preset.settings});
  fmt::print("{}", measure::to_markdown(table));
}

void make_presets(const PresetsCommand& command) {
  const auto combinations = experiments::read_swept_settings(measure::read_csv(command.from));
  const experiments::PresetPicks picks = experiments::pick_presets(combinations);
  fmt::print("// Made by: nightview presets --from {} --class {}\n{}", command.from,
             command.device_class,
             experiments::to_preset_lines(command.device_class, combinations, picks));
  for (const std::size_t i : {picks.fast, picks.balanced, picks.accurate})
    fmt::print("// {}: {:.3g} ms, relative MSE {:.3g}\n", combinations[i].settings,
               combinations[i].ms, combinations[i].relative_mse);
}

}  // namespace

void add_presets_command(CLI::App& app) {
  auto command = std::make_shared<PresetsCommand>();
  CLI::App* sub =
      app.add_subcommand("presets", "List the presets, or make them anew from a sweep's table");
  sub->footer(
      "With --from it prints the lines of runtime/render/preset_table.inc for a class of devices: "
      "from the\n"
      "Pareto front of one frame, over all views of the sweep, the cheapest settings with an error "
      "of use,\n"
      "the knee, and the smallest error.\n"
      "Examples:\n"
      "  nightview presets\n"
      "  nightview sweep city.glb --out sweep --views overview,street --repeats 3 --estimator "
      "pairwise,traced \\\n"
      "      --candidates 1,2,4,8,16,32,64 --neighbours 0,1,2,3,4,6\n"
      "  nightview presets --from sweep/sweep.csv --class gpu");
  sub->add_option("--from", command->from, "sweep.csv of nightview sweep");
  sub->add_option("--class", command->device_class, "Class of the device that was measured")
      ->capture_default_str()
      ->check(CLI::IsMember({"cpu", "gpu"}));
  sub->callback([command] { command->from.empty() ? list_all() : make_presets(*command); });
}

}  // namespace nightcity::nightview
