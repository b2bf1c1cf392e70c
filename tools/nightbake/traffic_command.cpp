// nightbake traffic: the drives of a night, without baking the city.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/error.h"
#include "tools/bake/city/city_ground.h"
#include "tools/bake/city/model_streets.h"
#include "tools/bake/report/traffic_report.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/traffic_stage.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/progress_line.h"

namespace nightcity {
namespace {

struct TrafficArguments {
  std::vector<std::filesystem::path> inputs;
  std::string out, lights;
  std::optional<double> vehicles;
  bool json = false;
};

struct Made {
  Georeference georeference;
  StreetReport streets;
  traffic::TrafficSet traffic;
};

/// Of the light file that the drives are to go into, where there is one.
Georeference placed(const Georeference& own, const std::optional<LightFile>& lights,
                    const TrafficArguments& arguments) {
  if (!lights) return own;
  if (lights->georeference().crs != own.crs)
    throw Error(arguments.lights,
                "is in " + lights->georeference().crs + ", the streets in " + own.crs);
  return lights->georeference();
}

Made drive_through_city(const Recipe& recipe, OsmData& osm, const std::optional<LightFile>& lights,
                        const TrafficArguments& arguments) {
  const CityFrames frames(recipe);
  Made made;
  made.georeference = placed(georeference_of(recipe, frames), lights, arguments);
  ProgressLine progress;
  Terrain terrain;
  std::optional<WindowLayout> no_windows;
  streets::RoadSurfaces roads;
  const bool model_streets = wants_model_streets(recipe, osm, frames);
  read_ground(recipe, frames, terrain, no_windows, progress.sink(),
              model_streets ? &roads : nullptr);
  if (model_streets) made.streets = add_model_streets(roads, frames, osm);
  made.traffic =
      make_city_traffic(recipe, osm, frames, terrain, made.georeference, progress.sink());
  return made;
}

Made drive_through_map(const Recipe& recipe, const OsmData& osm,
                       const std::optional<LightFile>& lights, const TrafficArguments& arguments) {
  const MapFrame map(osm);
  Made made;
  made.georeference = placed(map.georeference(recipe), lights, arguments);
  ProgressLine progress;
  made.traffic = make_map_traffic(recipe, osm, map.frame, made.georeference, progress.sink());
  return made;
}

void run(const TrafficArguments& arguments) {
  Recipe recipe = recipe_of(arguments.inputs);
  recipe.traffic.drives = true;
  if (arguments.vehicles) recipe.traffic.options.vehicles = arguments.vehicles;
  std::optional<LightFile> lights;
  LightFileContent content;
  if (!arguments.lights.empty()) {
    lights = LightFile::open(arguments.lights);
    content = content_of(*lights);
  }
  OsmData osm;
  for (const auto& file : recipe.osm.files) osm.merge(read_osm(file));
  const Made made = recipe.city.files.empty() ? drive_through_map(recipe, osm, lights, arguments)
                                              : drive_through_city(recipe, osm, lights, arguments);
  content.georeference = made.georeference;
  write_with_traffic(arguments.out, content, made.traffic);
  if (arguments.json) {
    nlohmann::json report = to_json(made.traffic.report);
    report["streets"] = to_json(made.streets);
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}{}", to_text(made.streets), to_text(made.traffic.report));
  }
}

}  // namespace

void add_traffic_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "traffic",
      "Drive vehicles through a city's or a map's streets and write their drives to a light file");
  auto arguments = std::make_shared<TrafficArguments>();
  command
      ->add_option(
          "input", arguments->inputs,
          "Recipe (TOML): [city] files for the ground, [osm] files for the streets, [traffic]; or "
          "the files themselves")
      ->required();
  command->add_option("-o,--out", arguments->out, "Light file to write")->required();
  command->add_option("--lights", arguments->lights,
                      "Light file whose lights go into it too; the traffic it has is replaced");
  command
      ->add_option(
          "--vehicles", arguments->vehicles,
          "On the road at 22:00 (default: as the recipe says, else by the table of densities)")
      ->check(CLI::Range(0.0, 1e6));
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer(
      "[traffic] may say vehicles = N (at 22:00) or per_km = X (of lane), cycle_s, side = \"left\" "
      "or "
      "\"right\",\n"
      "hours = [24 shares from noon on] and seed. `nightbake run` bakes the same traffic, with "
      "bodies.\n"
      "Where there is no map, streets are the middles of the model's roads; a map without CityGML "
      "is driven "
      "on\n"
      "a plane at height 0.\n"
      "Examples: nightbake traffic town.toml --out traffic.lights\n"
      "          nightbake traffic town.toml --lights city.lights --out city.lights\n"
      "          nightbake traffic map.osm.pbf --vehicles 300 --out traffic.lights");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity
