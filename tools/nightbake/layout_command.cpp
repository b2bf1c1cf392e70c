// nightbake layout: street lamps along a city's streets, and the light that they give, without
// baking it.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "formats/program/print_json.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/city/road_consumer.h"
#include "tools/bake/report/layout_report.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/layout/lamp_osm.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct LayoutArguments {
  std::string recipe, out;
  bool json = false;
};

void lay_out(const bake::BakeOptions& options, const LayoutArguments& arguments) {
  bake::City city(options.city);
  city.frames();  // the command needs a city model
  bake::CityLamps lamps;
  {
    ShownProgress progress;
    bake::read_ground_and_streets(city, options.uses_streets(), progress.sink());
    lamps = bake::place_city_lamps(city, options.lights.lamps);
  }
  if (!arguments.out.empty()) {
    std::span<const lights::PlacedLamp> laid_out = lamps.set.lamps;
    laid_out = laid_out.last(lamps.layout.lamps);
    const std::size_t written = layout::write_lamp_osm(
        arguments.out, laid_out, [&](const glm::dvec2& p) { return city.frame().to_lon_lat(p); });
    spdlog::info("{}: {} lamps", arguments.out, written);
  }
  const bool streets = spdlog::should_log(spdlog::level::debug);
  if (arguments.json)
    program::print_json(bake::to_json(lamps.layout, streets));
  else
    fmt::print("{} lamps mapped\n{}", lamps.set.lamps.size() - lamps.layout.lamps,
               bake::to_text(lamps.layout, streets));
}

void run(const LayoutArguments& arguments) {
  bake::BakeOptions options = bake::make_stage_options(bake::read_recipe(arguments.recipe));
  bake::use_best_levels(options.city, [&] { lay_out(options, arguments); });
}

}  // namespace

void add_layout_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("layout",
                         "Place street lamps along the streets of a recipe's city and print the "
                         "illuminance that each class of road gets");
  auto arguments = std::make_shared<LayoutArguments>();
  command
      ->add_option("recipe", arguments->recipe,
                   "Recipe (TOML); its keys [lamps] layout and class say how")
      ->required();
  command->add_option("-o,--out,--output,--osm", arguments->out,
                      "Write the laid-out lamps as an OSM file, for [osm] files");
  command->add_flag("--json", arguments->json,
                    "Print the report as JSON; with --verbose it has a row for each street, as the "
                    "text has");
  command->footer(
      "Illuminances are those of new luminaires; 0.8 times these are left when the class "
      "(EN 13201-2) must still be met.\n"
      "Example: nightbake layout town.toml --out lamps.osm");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
