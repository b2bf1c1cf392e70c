// nightbake layout: street lamps along a city's streets, and the light they give, without baking it.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tools/bake/city/city_ground.h"
#include "tools/bake/city/model_streets.h"
#include "tools/bake/report/layout_report.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/layout/lamp_osm.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/progress_line.h"

namespace nightcity {
namespace {

struct LayoutArguments {
  std::string recipe, osm;
  bool json = false;
};

void run(const LayoutArguments& arguments) {
  const Recipe recipe = read_recipe(arguments.recipe);
  const CityFrames frames(recipe);
  OsmData osm;
  for (const auto& file : recipe.osm.files) osm.merge(read_osm(file));
  Terrain terrain;
  CityLamps lamps;
  {
    ProgressLine progress;
    std::optional<WindowLayout> no_windows;
    streets::RoadSurfaces roads;
    const bool model_streets = wants_model_streets(recipe, osm, frames);
    read_ground(recipe, frames, terrain, no_windows, progress.sink(),
                model_streets ? &roads : nullptr);
    if (model_streets) add_model_streets(roads, frames, osm);
    lamps = place_city_lamps(recipe, osm, frames, terrain);
  }
  if (!arguments.osm.empty()) {
    std::span<const PlacedLamp> laid = lamps.set.lamps;
    laid = laid.last(lamps.layout.lamps);
    const std::size_t written = layout::write_lamp_osm(
        arguments.osm, laid, [&](const glm::dvec2& p) { return frames.city().to_lon_lat(p); });
    spdlog::info("{}: {} lamps", arguments.osm, written);
  }
  const bool streets = spdlog::should_log(spdlog::level::debug);
  if (arguments.json)
    fmt::print("{}\n", to_json(lamps.layout, streets)
                           .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    fmt::print("{} lamps mapped\n{}", lamps.set.lamps.size() - lamps.layout.lamps,
               to_text(lamps.layout, streets));
}

}  // namespace

void add_layout_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "layout",
      "Lay street lamps along the streets of a recipe and tell what light each class of road gets");
  auto arguments = std::make_shared<LayoutArguments>();
  command
      ->add_option("recipe", arguments->recipe, "Recipe (TOML); [lamps] layout and class say how")
      ->required();
  command->add_option("--osm", arguments->osm,
                      "Write the laid-out lamps as an OSM file, for [osm] files");
  command->add_flag("--json", arguments->json,
                    "Print JSON; with --verbose a row for each street, as in text");
  command->footer(
      "Illuminances are of new luminaires; x 0.8 is what is left when the class (EN 13201-2) must "
      "still be "
      "met.");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity
