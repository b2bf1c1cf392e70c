// nightbake lamps: street lamps out of OpenStreetMap, without baking a city.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "formats/error.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "formats/to_lower.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/read_inputs.h"
#include "tools/bake/report/layout_report.h"
#include "tools/bake/report/light_report.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/layout/lamp_osm.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct LampsArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path out;
  bool lay_out = false, json = false;
};

bake::BakeOptions read_options(const LampsArguments& arguments) {
  bake::BakeOptions options = bake::make_stage_options(bake::read_inputs(arguments.inputs));
  if (options.city.maps.empty() && options.city.inventories.empty())
    throw UsageError(options.city.name(),
                     "neither a map nor an inventory among the inputs: lamps come from these");
  // Files given alone: what the map has and no more.
  if (options.city.recipe.empty() && !arguments.lay_out)
    options.lights.lamps.layout.mode = layout::LayoutOptions::Mode::never;
  return options;
}

void write(const bake::City& city, const lights::LampSet& lamps, const std::filesystem::path& out) {
  const std::string ending = to_lower(out.extension().string());
  if (ending == ".lights") bake::write_lamp_lights(out, lamps, city.georeference());
  if (ending == ".osm")
    layout::write_lamp_osm(out, lamps.lamps,
                           [&](const glm::dvec2& p) { return city.frame().to_lon_lat(p); });
}

void place_lamps(const bake::BakeOptions& options, const LampsArguments& arguments) {
  bake::City city(options.city);
  bake::CityLamps lamps;
  {
    ShownProgress progress;
    city.read({}, progress.sink());
    city.build_ground();
    lamps = bake::place_city_lamps(city, options.lights.lamps);
  }
  write(city, lamps.set, arguments.out);
  const bake::LampReport report = bake::to_report(lamps.set, city);
  if (arguments.json) {
    nlohmann::json result = bake::to_json(report);
    result["layout"] = bake::to_json(lamps.layout, false);
    program::print_json(result);
  } else {
    fmt::print("{}{}", bake::to_text(report), bake::to_text(lamps.layout, false));
  }
}

void run(const LampsArguments& arguments) {
  const std::string extension = to_lower(arguments.out.extension().string());
  if (!arguments.out.empty() && extension != ".lights" && extension != ".osm")
    throw UsageError(arguments.out.string(), "is named neither .lights nor .osm");
  bake::BakeOptions options = read_options(arguments);
  // Only the lamps of a map are written: over the map itself, the rest of it would be lost.
  std::error_code ignored;
  for (const std::filesystem::path& map : options.city.maps)
    if (std::filesystem::equivalent(map, arguments.out, ignored))
      throw UsageError(arguments.out.string(),
                       "is one of the inputs, and would hold its lamps alone: name another file");
  bake::use_best_levels(options.city, [&] { place_lamps(options, arguments); });
}

}  // namespace

void add_lamps_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "lamps",
      "Place the street lamps of a map, with or without a city model, and print their values");
  auto arguments = std::make_shared<LampsArguments>();
  command
      ->add_option(
          "input", arguments->inputs,
          "OSM files (.osm, .osm.pbf, .osm.gz, .osm.bz2, .json), with a city model for the ground, "
          "or a recipe (TOML)")
      ->required();
  program::add_output_option(
      *command, arguments->out,
      "File to write: .lights, or .osm with heights, lumens, colours and aims as tags");
  command->add_flag("--lay-out", arguments->lay_out,
                    "With files instead of a recipe: also place lamps along streets where the map "
                    "has none (a recipe decides this itself)");
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer(
      "Without a city model a lamp stands at the height in its tag ele (nightbake elevate writes "
      "it), "
      "else at 0.\n"
      "Example: nightbake lamps map.osm.pbf city.gml -o lamps.lights");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
