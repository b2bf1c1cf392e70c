// The ground to the horizon through a whole bake.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/random.h"
#include "tools/terrain/horizon.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

fs::path write_small_town(const fs::path& folder, const std::string& more = {}) {
  town::TownOptions options;
  options.columns = options.rows = 2;
  town::write_town(options, folder);
  std::ofstream(folder / "small.toml") << "[city]\nfiles = ['town.gml']\n"
                                          "[osm]\nfiles = ['town.osm']\n"
                                       << more;
  return folder / "small.toml";
}

// The triangles of the nodes of some kinds, in model space.
std::vector<std::array<glm::dvec3, 3>> find_triangles(const Scene& scene,
                                                      const std::set<std::string>& kinds) {
  std::vector<std::array<glm::dvec3, 3>> found;
  for (const SceneNode& node : scene.nodes)
    if (kinds.contains(node.kind))
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
          std::array<glm::dvec3, 3> corners;
          for (std::size_t k = 0; k < 3; ++k)
            corners[k] = glm::dvec3(node.instances[0].to_model *
                                    glm::vec4(primitive.positions[primitive.indices[i + k]], 1));
          found.push_back(corners);
        }
  return found;
}

bool holds(const std::array<glm::dvec3, 3>& t, double x, double z) {
  int sides = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
    const double area = (b.x - a.x) * (z - a.z) - (b.z - a.z) * (x - a.x);
    sides += area > 0 ? 1 : -1;
  }
  return std::abs(sides) == 3;
}

TEST(BakeHorizon, EveryPlaceHasTheCitysGroundOrTheHorizonsAndNotBoth) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_small_town(folder.path())), folder / "out");
  const Scene scene = read_scene(folder / "out/city.glb");
  const auto ground = find_triangles(scene, {"terrain", "road"}),
             horizon = find_triangles(scene, {"horizon"});
  EXPECT_EQ(report.horizon.triangles, horizon.size());
  EXPECT_LT(horizon.size(), 2000u);
  glm::dvec3 low(1e9), high(-1e9);
  for (const auto& triangle : ground)
    for (const glm::dvec3& p : triangle) low = glm::min(low, p), high = glm::max(high, p);
  Random random{5};
  int on_ground = 0, beyond = 0;
  for (int i = 0; i < 400; ++i) {
    const double x = random.range(low.x - 60, high.x + 60),
                 z = random.range(low.z - 60, high.z + 60);
    const auto count = [&](const auto& triangles) {
      return std::count_if(triangles.begin(), triangles.end(),
                           [&](const auto& t) { return holds(t, x, z); });
    };
    const auto city = count(ground), far = count(horizon);
    EXPECT_EQ(far, city > 0 ? 0 : 1) << x << " " << z;
    (city > 0 ? on_ground : beyond) += 1;
  }
  EXPECT_GT(on_ground, 50);
  EXPECT_GT(beyond, 50);
}

TEST(BakeHorizon, BeginsAtVerticesOfTheGroundAndReachesFiftyKilometres) {
  const TempFolder folder;
  bake(read_recipe(write_small_town(folder.path())), folder / "out");
  const Scene scene = read_scene(folder / "out/city.glb");
  const auto round = [](const glm::dvec3& p) {
    return std::tuple(std::llround(p.x * 100), std::llround(p.y * 100), std::llround(p.z * 100));
  };
  std::set<std::tuple<long long, long long, long long>> vertices;
  for (const auto& triangle : find_triangles(scene, {"terrain", "road"}))
    for (const glm::dvec3& p : triangle) vertices.insert(round(p));
  std::size_t shared = 0;
  double farthest = 0;
  for (const auto& triangle : find_triangles(scene, {"horizon"}))
    for (const glm::dvec3& p : triangle) {
      shared += vertices.contains(round(p));
      farthest = std::max({farthest, std::abs(p.x), std::abs(p.z)});
    }
  EXPECT_GT(shared, 30u);
  EXPECT_NEAR(farthest, terrain::horizon_m, 1000);
  for (const SceneNode& node : scene.nodes)
    EXPECT_TRUE(node.kind != "horizon" || !node.casts_shadow);
}

TEST(BakeHorizon, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_small_town(folder.path()), folder.path(), {3});
}

TEST(BakeHorizon, OneWordTurnsItOff) {
  const TempFolder folder;
  const BakeReport report = bake(
      read_recipe(write_small_town(folder.path(), "[ground]\nhorizon = false\n")), folder / "out");
  EXPECT_EQ(report.horizon.triangles, 0u);
  EXPECT_TRUE(find_triangles(read_scene(folder / "out/city.glb"), {"horizon"}).empty());
}

TEST(BakeHorizon, AGroundThatIsNotShownHasNone) {
  const TempFolder folder;
  std::ofstream(folder / "map.osm")
      << "<osm version='0.6'><node id='1' lon='13' lat='52'/><node id='2' lon='13.0002' lat='52'/>"
         "<node id='3' lon='13.0002' lat='52.0001'/><way id='1'><nd ref='1'/><nd ref='2'/>"
         "<nd ref='3'/><nd ref='1'/><tag k='building' v='yes'/></way></osm>";
  for (const bool shown : {true, false}) {
    std::ofstream(folder / "map.toml")
        << "[osm]\nfiles = ['map.osm']\n[terrain]\nmake_surface = " << (shown ? "true" : "false")
        << "\n";
    const BakeReport report = bake(read_recipe(folder / "map.toml"), folder / "out");
    EXPECT_EQ(report.horizon.triangles > 0, shown);
    EXPECT_EQ(report.horizon.rings, shown ? 1u : 0u);
  }
}

}  // namespace
}  // namespace nightcity::bake
