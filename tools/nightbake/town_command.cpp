// nightbake town: a synthetic town as CityGML, OSM extract and recipe.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "tools/nightbake/commands.h"
#include "tools/town/town.h"

namespace nightcity {
namespace {

struct TownArguments {
  town::TownOptions town;
  std::string folder;
  std::size_t blocks = 0, buildings = 0, triangles = 0;
};

void run(TownArguments& arguments) {
  if (arguments.blocks) town::size_for_blocks(arguments.town, arguments.blocks);
  if (arguments.buildings) town::size_for_buildings(arguments.town, arguments.buildings);
  if (arguments.triangles) town::size_for_triangles(arguments.town, arguments.triangles);
  const town::TownCounts counts = town::write_town(arguments.town, arguments.folder);
  fmt::print("{}/town.toml: {} blocks, {} buildings, {} polygons, about {} triangles, {} lamps\n",
             arguments.folder, counts.blocks, counts.buildings, counts.polygons, counts.triangles,
             counts.lamps);
}

}  // namespace

void add_town_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("town", "Write a synthetic town: town.gml, town.osm and town.toml");
  auto arguments = std::make_shared<TownArguments>();
  command->add_option("-o,--out", arguments->folder, "Folder to write into")->required();
  command->add_option("--seed", arguments->town.seed, "Another seed, another town")
      ->capture_default_str();
  auto* size = command->add_option_group("size", "At most one; the default is a town of 56 blocks");
  size->add_option("--blocks", arguments->blocks, "Blocks of houses, about")
      ->check(CLI::PositiveNumber);
  size->add_option("--buildings", arguments->buildings, "Buildings, about")
      ->check(CLI::PositiveNumber);
  size->add_option("--triangles", arguments->triangles, "Triangles, about")
      ->check(CLI::PositiveNumber);
  size->require_option(0, 1);
  command
      ->add_option("--lamps", arguments->town.lamps,
                   "Luminaires, exactly (default: as streets need)")
      ->check(CLI::PositiveNumber);
  command->add_option("--hills", arguments->town.hills_m, "Height from valley to hilltop, m")
      ->capture_default_str();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity
