// nightbake traffic: the traffic of a night, without baking the city.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/light_file_edit.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/city/road_consumer.h"
#include "tools/bake/read_inputs.h"
#include "tools/bake/report/traffic_report.h"
#include "tools/bake/stages/traffic_stage.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct TrafficArguments {
  std::vector<std::filesystem::path> inputs;
  std::string out, lights;
  std::optional<double> vehicles;
  bool json = false;
};

// Returns the georeference of the light file that the traffic is added to, where there is one, else
// the city's.
Georeference find_georeference(const bake::City& city, const std::optional<LightFile>& lights,
                               const TrafficArguments& arguments) {
  Georeference own = city.georeference();
  if (!lights) return own;
  if (lights->georeference().crs != own.crs)
    throw Error(arguments.lights,
                "is in " + lights->georeference().crs + ", but the streets are in " + own.crs);
  return lights->georeference();
}

void make_traffic(const bake::BakeOptions& options, const TrafficArguments& arguments) {
  std::optional<LightFile> lights;
  LightFileContent content;
  if (!arguments.lights.empty()) {
    lights = LightFile::open(arguments.lights);
    lights->verify();
    content = to_content(*lights);
  }
  bake::City city(options.city);
  content.georeference = find_georeference(city, lights, arguments);
  bake::StreetReport streets;
  traffic::TrafficSet traffic;
  {
    ShownProgress progress;
    streets = bake::read_ground_and_streets(city, true, progress.sink());
    traffic = bake::make_city_traffic(city, options.traffic, content.georeference, progress.sink());
  }
  write_with_traffic(arguments.out, content, bake::to_addition(traffic));
  if (arguments.json) {
    nlohmann::json report = bake::to_json(traffic.report);
    report["streets"] = bake::to_json(streets);
    program::print_json(report);
  } else {
    fmt::print("{}{}", bake::to_text(streets), bake::to_text(traffic.report));
  }
}

void run(const TrafficArguments& arguments) {
  bake::BakeOptions options = bake::make_stage_options(bake::read_inputs(arguments.inputs));
  if (arguments.vehicles) options.traffic.vehicles = arguments.vehicles;
  bake::use_best_levels(options.city, [&] { make_traffic(options, arguments); });
}

}  // namespace

void add_traffic_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "traffic",
      "Make the traffic of a night on the streets of a city or a map and write it to a light file");
  auto arguments = std::make_shared<TrafficArguments>();
  command
      ->add_option("input", arguments->inputs,
                   "Recipe (TOML): [city] files for the ground, [osm] files for the streets, "
                   "[traffic]; or the files themselves")
      ->required();
  program::add_output_option(*command, arguments->out, "Light file to write")->required();
  command->add_option("--lights", arguments->lights,
                      "Light file whose lights are copied too; its traffic is replaced");
  command
      ->add_option("--vehicles", arguments->vehicles,
                   "Vehicles on the road at 22:00 (default: the recipe's, else by the table of "
                   "densities)")
      ->check(program::number_from(0, 1e6));
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer(
      "[traffic] takes vehicles = N (at 22:00) or per_km = X (per km of lane), cycle_s, side = "
      "\"left\" or \"right\",\n"
      "hours = [24 shares from noon on] and seed. `nightbake run` makes the same traffic, and "
      "shows "
      "it in city.glb.\n"
      "Without a map the streets are the centrelines of the model's roads. Without a city model "
      "they "
      "lie "
      "on a plane at height 0.\n"
      "Examples: nightbake traffic town.toml --out traffic.lights\n"
      "          nightbake traffic town.toml --lights city.lights --out city.lights\n"
      "          nightbake traffic map.osm.pbf --vehicles 300 --out traffic.lights");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
