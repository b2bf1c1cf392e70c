// nightbake elevate: the ground's height under each lamp of a map, written into the map.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/city.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/read_inputs.h"
#include "tools/bake/report/report_text.h"
#include "tools/elevation/elevate.h"
#include "tools/elevation/osm_elevations.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;

struct ElevateArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path out, dem;
  std::string dem_crs;  // "": that of the recipe's [terrain] dem_crs
  elevation::ElevationServiceOptions service;
  int wait_ms = 1000;
  bool json = false;
};

struct Outcome {
  std::size_t lamps = 0, written = 0;
  elevation::Elevations elevations;
};

bake::BakeOptions read_options(const ElevateArguments& arguments) {
  bake::BakeOptions options = bake::make_stage_options(bake::read_inputs(arguments.inputs));
  if (options.city.maps.size() != 1)
    throw UsageError(options.city.name(),
                     "give exactly one OSM file: its lamps get heights and it is written anew");
  if (options.city.files.empty() && arguments.dem.empty() && arguments.service.url.empty())
    throw UsageError(options.city.name(),
                     "nothing to take heights from: give a city model, --dem or --service");
  if (!arguments.dem_crs.empty() && arguments.dem.empty())
    throw UsageError("--dem-crs", "names the CRS of the raster of --dem, which is not given");
  return options;
}

Outcome elevate(const bake::BakeOptions& options, const ElevateArguments& arguments) {
  bake::City city(options.city);
  elevation::ElevationSources sources;
  std::optional<elevation::DemRaster> dem;
  const bake::GroundOptions& ground = options.city.ground;
  const std::string& crs = arguments.dem_crs.empty() ? ground.elevation_crs : arguments.dem_crs;
  if (!arguments.dem.empty())
    sources.dem = &dem.emplace(
        arguments.dem,
        terrain::ElevationOptions{ground.max_dem_block_mpx, ground.max_dem_unpacked_mb, crs});
  ShownProgress progress;
  if (city.has_model()) {
    city.require_lon_lat("lamps have no place in it");
    city.read({}, progress.sink());
    city.build_ground();
    sources.terrain = &city.terrain();
    sources.to_frame = city.to_frame();
  }
  elevation::ElevationServiceOptions service = arguments.service;
  service.first_wait = std::chrono::milliseconds(arguments.wait_ms);
  service.progress = [sink = progress.sink()](std::size_t done, std::size_t total) {
    sink({"asking the service", done, "places", total});
  };
  if (!service.url.empty()) sources.service = &service;
  // Heights are written on nodes: a lamp mapped as an area has none of its own.
  std::vector<osm::OsmLampNode> lamps = city.map().lamps;
  std::erase_if(lamps, [](const osm::OsmLampNode& lamp) { return lamp.is_way; });
  Outcome outcome{lamps.size(), 0, elevation::elevate_lamps(lamps, sources)};
  if (!arguments.out.empty())
    outcome.written = elevation::write_elevations(options.city.maps.front(), arguments.out,
                                                  outcome.elevations.heights);
  return outcome;
}

json offset_json(const elevation::HeightOffset& offset) {
  return {{"m", offset.metres}, {"deviation_m", offset.deviation}, {"samples", offset.samples}};
}

void print(const Outcome& outcome) {
  const elevation::Elevations& found = outcome.elevations;
  fmt::print("{} lamps, {} with a height\nheights from {}\n", outcome.lamps, found.heights.size(),
             bake::in_words(found.sources));
  fmt::print("{} outside the model, {} inside buildings, {} mapped twice\n", found.outside_model,
             found.inside_buildings, found.duplicates);
  const auto offset = [](const char* name, const elevation::HeightOffset& value) {
    if (value.samples)
      fmt::print("{}: {:+.2f} m to the model's heights (deviation {:.2f} m, {} places)\n", name,
                 value.metres, value.deviation, value.samples);
  };
  offset("raster", found.raster_offset);
  offset("service", found.service_offset);
  const elevation::ElevationAnswers& service = found.service;
  if (!service.heights.empty())
    fmt::print(
        "service: {} requests, {} of them again, {} places from the cache, {} answers of 0 m "
        "refused\n",
        service.requests, service.retries, service.from_cache, service.zeros_refused);
  if (outcome.written) fmt::print("{} nodes written\n", outcome.written);
}

void run(const ElevateArguments& arguments) {
  bake::BakeOptions options = read_options(arguments);
  const Outcome outcome =
      bake::use_best_levels(options.city, [&] { return elevate(options, arguments); });
  if (!arguments.json) return print(outcome);
  const elevation::Elevations& found = outcome.elevations;
  const json result = {{"lamps", outcome.lamps},
                       {"heights", found.heights.size()},
                       {"sources", found.sources},
                       {"outside_model", found.outside_model},
                       {"inside_buildings", found.inside_buildings},
                       {"duplicates", found.duplicates},
                       {"raster_offset", offset_json(found.raster_offset)},
                       {"service_offset", offset_json(found.service_offset)},
                       {"service",
                        {{"requests", found.service.requests},
                         {"retries", found.service.retries},
                         {"from_cache", found.service.from_cache},
                         {"zeros_refused", found.service.zeros_refused}}},
                       {"written", outcome.written}};
  program::print_json(result);
}

}  // namespace

void add_elevate_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "elevate", "Find the ground's height under the lamps of a map and write it into the map");
  auto arguments = std::make_shared<ElevateArguments>();
  command
      ->add_option("input", arguments->inputs,
                   "One OSM file and the city model it belongs to, or a recipe (TOML)")
      ->required();
  program::add_output_option(*command, arguments->out,
                             "The map with a tag ele on its lamps (.osm, .osm.pbf, ...)");
  command->add_option("--dem", arguments->dem,
                      "Raster of heights (GeoTIFF, ...) for lamps outside the model, also "
                      "packed (.gz, .zip, .7z, ...), or a folder of such");
  command->add_option("--dem-crs", arguments->dem_crs,
                      "CRS of that raster where it names none, as tables of x y z do "
                      "(EPSG:25832); without it that of a .prj beside it, or [terrain] dem_crs");
  command->add_option("--service", arguments->service.url,
                      "Service for the lamps that are still without a height, compatible with "
                      "Open-Elevation: http://.../api/v1/lookup");
  command->add_option("--cache", arguments->service.cache, "File that keeps the service's answers");
  command->add_option("--batch", arguments->service.batch, "Places in one request")
      ->capture_default_str()
      ->check(program::count_from(1, 10000));
  command
      ->add_option("--attempts", arguments->service.attempts,
                   "How often a request is sent while the service is busy")
      ->capture_default_str()
      ->check(program::count_from(1, 20));
  command
      ->add_option("--wait-ms", arguments->wait_ms,
                   "Wait before the second attempt, in ms; doubled after each")
      ->capture_default_str()
      ->check(program::count_from(1, 60000));
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer(
      "The model's terrain and roads are asked first, then its buildings' ground, then the raster, "
      "then the service.\n"
      "One number each moves the heights of raster and service to the model's.\n"
      "Example: nightbake elevate lamps.osm city.gml --dem dem.tif -o lamps_with_ele.osm");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
