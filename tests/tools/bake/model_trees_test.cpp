// Trees of a city model through a whole bake: in place of its surfaces, before the map's own trees,
// whatever the number of parts.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/bake/scene/materials.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

town::TownCounts write_planted_town(const fs::path& folder) {
  town::TownOptions options;
  options.columns = options.rows = 2;
  return town::write_town(options, folder);
}

fs::path write_recipe(const fs::path& folder, const std::string& more) {
  std::ofstream(folder / "trees.toml") << "[city]\nfiles = ['town.gml']\n" << more;
  return folder / "trees.toml";
}

struct Shown {
  std::size_t trunks = 0, crowns = 0, bare = 0, vegetation_triangles = 0;
  explicit Shown(const fs::path& glb) {
    const Scene scene = read_scene(glb);
    for (const SceneNode& node : scene.nodes) {
      if (node.name == "trunks") trunks += node.instances.size();
      if (node.name == "crowns") crowns += node.instances.size();
      if (node.name == "bare crowns") bare += node.instances.size();
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        if (scene.materials[primitive.material].name == "vegetation")
          vegetation_triangles += primitive.indices.size() / 3;
    }
  }
};

Shown bake_town(const fs::path& folder, const std::string& more) {
  bake(read_recipe(write_recipe(folder, more)), folder / "out");
  return Shown(folder / "out/city.glb");
}

TEST(BakeModelTrees, TheWordOfTheRecipeDecidesWhatStands) {
  const TempFolder folder;
  const std::size_t trees = write_planted_town(folder.path()).trees;
  ASSERT_GT(trees, 10u);
  const Shown usual = bake_town(folder.path(), "");
  EXPECT_EQ(usual.trunks, trees);
  EXPECT_EQ(usual.crowns, trees);
  EXPECT_EQ(usual.vegetation_triangles, 0u);
  const Shown winter = bake_town(folder.path(), "[ground]\ntrees = 'winter'\n");
  EXPECT_EQ(winter.trunks, trees);
  EXPECT_EQ(winter.bare, trees);
  const Shown surfaces = bake_town(folder.path(), "vegetation = 'surfaces'\n");
  EXPECT_EQ(surfaces.trunks, 0u);
  EXPECT_EQ(surfaces.vegetation_triangles, 32 * trees);  // as the town draws one
  for (const char* none : {"vegetation = 'none'\n", "[ground]\ntrees = 'none'\n"}) {
    const Shown nothing = bake_town(folder.path(), none);
    EXPECT_EQ(nothing.trunks, 0u) << none;
    EXPECT_EQ(nothing.vegetation_triangles, 0u) << none;
  }
}

TEST(BakeModelTrees, ModelsOfPartsHaveTheSameTrees) {
  const TempFolder folder;
  write_planted_town(folder.path());
  expect_parts_as_whole(write_recipe(folder.path(), "[osm]\nfiles = ['town.osm']\n"),
                        folder / "out", {1, 3});
}

// A tree of a file that is not there, which is a point and a few attributes, beside the town's.
TEST(BakeModelTrees, ATreeWithoutSurfacesStandsOnTheGround) {
  const TempFolder folder;
  const std::size_t trees = write_planted_town(folder.path()).trees;
  const BakeReport before = bake(read_recipe(write_recipe(folder.path(), "")), folder / "out");
  std::ifstream in(folder / "town.gml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  // The place of the first tree's first corner, moved by 5 m, without a height.
  const std::size_t first = text.find("<gml:posList", text.find("<veg:SolitaryVegetationObject"));
  double east = 0, north = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find('>', first) + 1, "%lf %lf", &east, &north), 2);
  char tree[700];
  std::snprintf(tree, sizeof tree,
                "<core:cityObjectMember><veg:SolitaryVegetationObject gml:id=\"point\">"
                "<veg:height uom=\"m\">14</veg:height><veg:trunkDiameter>1e9</veg:trunkDiameter>"
                "<veg:lod1ImplicitRepresentation><core:ImplicitGeometry>"
                "<core:libraryObject>tree.wrl</core:libraryObject><core:referencePoint><gml:Point>"
                "<gml:pos srsDimension=\"2\">%.3f %.3f</gml:pos></gml:Point></core:referencePoint>"
                "</core:ImplicitGeometry></veg:lod1ImplicitRepresentation>"
                "</veg:SolitaryVegetationObject></core:cityObjectMember>\n",
                east + 5, north);
  text.insert(text.rfind("</core:CityModel>"), tree);
  std::ofstream(folder / "town.gml") << text;
  const BakeReport report = bake(read_recipe(write_recipe(folder.path(), "")), folder / "out");
  EXPECT_EQ(report.trees.sources.at("of the model"), trees + 1);
  EXPECT_EQ(report.trees.odd_sizes, 1u);
  EXPECT_EQ(report.ground.relief_points, before.ground.relief_points)
      << "the place of a tree is no height of the ground";
  const Scene scene = read_scene(folder / "out/city.glb");
  for (const SceneNode& node : scene.nodes)
    if (node.name == "crowns") {
      EXPECT_EQ(node.instances.size(), trees + 1);
    }
}

}  // namespace
}  // namespace nightcity::bake
