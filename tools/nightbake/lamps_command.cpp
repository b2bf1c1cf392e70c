// nightbake lamps: street lamps out of OSM, without baking a city.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/light_file_writer.h"
#include "tools/bake/city/city_ground.h"
#include "tools/bake/report/layout_report.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/layout/lamp_osm.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/progress_line.h"

namespace nightcity {
namespace {

struct LampsArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path out;
  bool lay_out = false, json = false;
};

void write_lights(const std::filesystem::path& path, const LampSet& set,
                  const Georeference& georeference) {
  LightFileWriter lights(path);
  ScheduleTable schedules = schedules_of(lights);
  for (const PlacedLamp& lamp : set.lamps)
    lights.add(to_light(lamp, georeference, schedules), lamp.provenance);
  lights.finish(
      {.georeference = georeference, .profiles = set.profiles, .profile_data = set.profile_data});
}

void run(const LampsArguments& arguments) {
  const std::string extension = arguments.out.extension().string();
  if (!arguments.out.empty() && extension != ".lights" && extension != ".osm")
    throw UsageError(arguments.out.string(), "is named neither .lights nor .osm");
  Recipe recipe = recipe_of(arguments.inputs);
  if (recipe.osm.files.empty())
    throw UsageError("", "no OSM file among the inputs: lamps come from the map");
  if (recipe.path.empty() && !arguments.lay_out)  // files alone: what the map has and no more
    recipe.lamps.layout.mode = layout::LayoutOptions::Mode::never;
  OsmData osm;
  for (const auto& file : recipe.osm.files) osm.merge(read_osm(file));

  CityLamps lamps;
  Georeference georeference;
  if (recipe.city.files.empty()) {
    const MapFrame map(osm);
    lamps = place_map_lamps(recipe, osm, map.frame);
    georeference = map.georeference(recipe);
    if (extension == ".osm")
      layout::write_lamp_osm(arguments.out, lamps.set.lamps,
                             [&](const glm::dvec2& p) { return map.frame.to_lon_lat(p); });
  } else {
    const CityFrames frames(recipe);
    Terrain terrain;
    std::optional<WindowLayout> no_windows;
    ProgressLine progress;
    read_ground(recipe, frames, terrain, no_windows, progress.sink());
    lamps = place_city_lamps(recipe, osm, frames, terrain);
    georeference = georeference_of(recipe, frames);
    if (extension == ".osm")
      layout::write_lamp_osm(arguments.out, lamps.set.lamps,
                             [&](const glm::dvec2& p) { return frames.city().to_lon_lat(p); });
  }
  if (extension == ".lights") write_lights(arguments.out, lamps.set, georeference);

  const LampReport report = report_of(lamps.set, osm.lamps.size());
  if (arguments.json) {
    nlohmann::json result = to_json(report);
    result["layout"] = to_json(lamps.layout, false);
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}{}", to_text(report), to_text(lamps.layout, false));
  }
}

}  // namespace

void add_lamps_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "lamps", "Place a map's street lamps, on a city or without one, and tell their values");
  auto arguments = std::make_shared<LampsArguments>();
  command
      ->add_option("input", arguments->inputs,
                   "OSM files (.osm, .osm.pbf, .osm.gz, .osm.bz2), with CityGML to stand on, or a "
                   "recipe (TOML)")
      ->required();
  command->add_option(
      "-o,--out", arguments->out,
      "What to write: lamps.lights, or lamps.osm with heights, lumens, colours and aims as tags");
  command->add_flag("--lay-out", arguments->lay_out,
                    "With files: also lay lamps along streets where the map has none (recipes say "
                    "it themselves)");
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer(
      "Without CityGML lamps stand at the height of their tag ele (nightbake elevate writes it), "
      "else at 0.\n"
      "Example: nightbake lamps map.osm.pbf city.gml -o lamps.lights");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity
