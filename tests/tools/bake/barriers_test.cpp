// Barriers of the map through a whole bake: on the ground of the scene, whatever the number of
// parts and threads.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/osm/read_osm.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

// Writes a town and a map of barriers beside its first lamps: a wall, a hedge and a fence of some
// 7 m each. Returns the recipe, which ends in `more`.
fs::path write_town_with_barriers(const fs::path& folder, const std::string& more = {}) {
  town::TownOptions options;
  options.columns = options.rows = 2;
  town::write_town(options, folder);
  const osm::OsmData town = osm::read_osm(folder / "town.osm");
  std::ofstream map(folder / "barriers.osm");
  map << "<osm version='0.6'>\n";
  const char* kinds[] = {"wall", "hedge", "fence"};
  for (int n = 0; n < 30; ++n) {
    const glm::dvec2 p = town.lamps.at(static_cast<std::size_t>(n)).lon_lat + 2e-5;
    char text[400];
    std::snprintf(text, sizeof text,
                  "<node id='%d' lon='%.7f' lat='%.7f'/><node id='%d' lon='%.7f' lat='%.7f'/>"
                  "<way id='%d'><nd ref='%d'/><nd ref='%d'/><tag k='barrier' v='%s'/></way>\n",
                  900'001 + 2 * n, p.x, p.y, 900'002 + 2 * n, p.x + 1e-4, p.y, 950'001 + n,
                  900'001 + 2 * n, 900'002 + 2 * n, kinds[n % 3]);
    map << text;
  }
  map << "</osm>\n";
  std::ofstream(folder / "barriers.toml") << "[city]\nfiles = ['town.gml']\n"
                                             "[osm]\nfiles = ['town.osm', 'barriers.osm']\n"
                                          << more;
  return folder / "barriers.toml";
}

std::size_t count_barrier_triangles(const fs::path& glb) {
  const Scene scene = read_scene(glb);
  std::size_t triangles = 0;
  for (const SceneNode& node : scene.nodes)
    if (node.kind == "barrier") {
      EXPECT_TRUE(node.casts_shadow);
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        triangles += primitive.indices.size() / 3;
    }
  return triangles;
}

TEST(BakeBarriers, TheReportSaysHowMuchOfTheMapsStands) {
  const TempFolder folder;
  const BakeReport report =
      bake(read_recipe(write_town_with_barriers(folder.path())), folder / "out");
  double built_m = 0;
  for (const char* name : {"wall", "hedge", "fence"}) {
    EXPECT_EQ(report.barriers.found.kinds.at(name).ways, 10u);
    built_m += report.barriers.found.kinds.at(name).built_m;
  }
  EXPECT_GT(built_m, 0);
  EXPECT_GT(report.barriers.triangles, 0u);
  EXPECT_EQ(count_barrier_triangles(folder / "out/city.glb"), report.barriers.triangles);
}

TEST(BakeBarriers, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_town_with_barriers(folder.path()), folder.path(), {3});
}

TEST(BakeBarriers, OneWordTurnsThemOffAndMovesNothingElse) {
  const TempFolder folder;
  bake(read_recipe(write_town_with_barriers(folder.path())), folder / "on");
  const BakeReport report =
      bake(read_recipe(write_town_with_barriers(folder.path(), "[ground]\nbarriers = false\n")),
           folder / "off");
  EXPECT_TRUE(report.barriers.found.kinds.empty());
  EXPECT_EQ(count_barrier_triangles(folder / "off/city.glb"), 0u);
  const Scene on = read_scene(folder / "on/city.glb"), off = read_scene(folder / "off/city.glb");
  EXPECT_EQ(on.georeference.origin, off.georeference.origin);
}

}  // namespace
}  // namespace nightcity::bake
