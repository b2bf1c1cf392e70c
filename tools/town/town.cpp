#include "tools/town/town.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <utility>

#include "formats/error.h"
#include "tools/town/building_plan.h"
#include "tools/town/gml_writer.h"
#include "tools/town/hills.h"
#include "tools/town/osm_writer.h"
#include "tools/town/roads.h"
#include "tools/town/street_plan.h"
#include "tools/town/text_file.h"
#include "tools/town/trees.h"

namespace nightcity::town {
namespace {

constexpr double fields_m = 150;   // width of the open ground around the town
constexpr int relief_cells = 20;   // a relief tile's side, in grid cells: 200 m
constexpr double max_roof_m = 80;  // above the hills

std::pair<glm::ivec2, glm::ivec2> relief_bounds(const StreetPlan& streets) {
  return {glm::ivec2(glm::floor((streets.low() - fields_m) / Hills::spacing_m)),
          glm::ivec2(glm::ceil((streets.high() + fields_m) / Hills::spacing_m))};
}

TownCounts write_gml(const TownOptions& options, const StreetPlan& streets, const Hills& hills,
                     const std::filesystem::path& path) {
  TextFile out(path);
  const auto [first, last] = relief_bounds(streets);
  GmlWriter gml(out, {options.origin_east_m, options.origin_north_m},
                {glm::dvec2(first) * Hills::spacing_m, std::floor(hills.lowest() - 1)},
                {glm::dvec2(last) * Hills::spacing_m, std::ceil(hills.highest() + max_roof_m)});
  for (int y = first.y; y < last.y; y += relief_cells)
    for (int x = first.x; x < last.x; x += relief_cells)
      gml.write_relief(hills, x, y, std::min(x + relief_cells, last.x),
                       std::min(y + relief_cells, last.y));
  for_each_road(streets, hills, [&](const RoadPlan& road) { gml.write_road(road); });
  for (int j = 0; j < streets.rows(); ++j)
    for (int i = 0; i < streets.columns(); ++i) {
      const std::vector<BuildingPlan> houses = plan_block(streets, hills, options.seed, i, j);
      for (const BuildingPlan& house : houses) gml.write_building(house, options.seed);
      for (const TreePlan& tree : plan_trees(streets, hills, houses, options.seed, i, j))
        gml.write_tree(tree);
    }
  gml.finish();
  out.finish();
  return gml.counts();
}

void write_recipe(const std::filesystem::path& path) {
  TextFile out(path);
  out << "# A synthetic town, made by `nightbake town`. Bake it: nightbake run town.toml --out "
         "DIR\n"
         "[city]\nfiles = [\"town.gml\"]\nroads = \"map\"\n\n[osm]\nfiles = [\"town.osm\"]\n\n"
         "[traffic]\n";
  out.finish();
}

/// Means over towns of 56 to 2500 blocks without their relief. Tests check that sizes made from
/// them are right to 10 %.
constexpr double buildings_per_block = 12.5, triangles_per_block = 1115;

}  // namespace

void size_for_blocks(TownOptions& options, std::size_t blocks) {
  const double wanted = static_cast<double>(std::max<std::size_t>(blocks, 1));
  options.rows = std::max(1, static_cast<int>(std::lround(std::sqrt(wanted * 7 / 8))));
  options.columns = std::max(1, static_cast<int>(std::ceil(wanted / options.rows)));
}

void size_for_buildings(TownOptions& options, std::size_t buildings) {
  size_for_blocks(options,
                  static_cast<std::size_t>(static_cast<double>(buildings) / buildings_per_block));
}

void size_for_triangles(TownOptions& options, std::size_t triangles) {
  const auto wanted = static_cast<double>(triangles);
  // The fields around the town weigh more in a small town: grow until blocks and relief together
  // suffice.
  for (std::size_t blocks = 1;; blocks += 1 + blocks / 64) {
    size_for_blocks(options, blocks);
    const auto [first, last] = relief_bounds(StreetPlan(options));
    const double relief = 2.0 * (last.x - first.x) * (last.y - first.y);
    if (relief + triangles_per_block * options.rows * options.columns >= wanted) return;
  }
}

TownCounts write_town(const TownOptions& options, const std::filesystem::path& folder) {
  constexpr int max_blocks = 1500;  // 150 km: beyond it the UTM zone ends
  if (options.columns < 1 || options.rows < 1 || options.columns > max_blocks ||
      options.rows > max_blocks)
    throw UsageError("town", "a town has 1 to " + std::to_string(max_blocks) + " blocks a side");
  if (!(options.hills_m >= 0 && options.hills_m <= 500))
    throw UsageError("town", "hills are 0 to 500 m high");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder.string(), "cannot make the folder: " + error.message());

  const StreetPlan streets(options);
  const Hills hills(options.seed, options.hills_m);
  TownCounts counts = write_gml(options, streets, hills, folder / "town.gml");
  {
    TextFile out(folder / "town.osm");
    counts.lamps = write_osm(out, streets, options);
    out.finish();
  }
  write_recipe(folder / "town.toml");
  counts.blocks =
      static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows);
  return counts;
}

}  // namespace nightcity::town
