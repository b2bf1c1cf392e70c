// nightbake town: a synthetic town as CityGML, OSM extract and recipe.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>
#include <string>

#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "tools/nightbake/commands.h"
#include "tools/town/town.h"

namespace nightcity::nightbake {
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
  program::require_writable_folder(arguments.folder);
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
  program::add_output_option(*command, arguments->folder, "Folder to write into")->required();
  command->add_option("--seed", arguments->town.seed, "Number that decides which town is made")
      ->capture_default_str()
      ->check(program::count_from(0, std::numeric_limits<std::uint64_t>::max()));
  auto* size = command->add_option_group(
      "size", "Size of the town: at most one of these; the default is 56 blocks");
  size->add_option("--blocks", arguments->blocks, "Approximate number of blocks of houses")
      ->check(program::count_from(1, 100'000'000));
  size->add_option("--buildings", arguments->buildings, "Approximate number of buildings")
      ->check(program::count_from(1, 100'000'000));
  size->add_option("--triangles", arguments->triangles, "Approximate number of triangles")
      ->check(program::count_from(1, 100'000'000));
  size->require_option(0, 1);
  command
      ->add_option("--lamps", arguments->town.lamps,
                   "Exact number of luminaires (default: as many as the streets need)")
      ->check(program::count_from(1, 100'000'000));
  command->add_option("--hills", arguments->town.hills_m, "Height from valley to hilltop, m")
      ->capture_default_str()
      ->check(program::number_from(0, 500));
  command->footer("Example: nightbake town --blocks 20 --out town");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
