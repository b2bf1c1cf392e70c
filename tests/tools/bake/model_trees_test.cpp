// Trees of a city model through a whole bake: in place of its surfaces, before the map's own trees,
// whatever the number of parts.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <utility>

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

// Shapes are in metres and places in degrees: trees stand 5 m east and north of their points. They have
// no ids, and stand on one line of the file.
TEST(BakeModelTrees, TreesOfModelsInDegreesStandWhereTheirMatrixSays) {
  const auto surface = [](const std::string& places) {
    return "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + places +
           "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
  };
  std::string text =
      "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
      "xmlns:gml=\"http://www.opengis.net/gml\" "
      "xmlns:luse=\"http://www.opengis.net/citygml/landuse/2.0\" "
      "xmlns:veg=\"http://www.opengis.net/citygml/vegetation/2.0\"><gml:boundedBy><gml:Envelope "
      "srsName=\"http://www.opengis.net/def/crs/EPSG/0/6697\"/></gml:boundedBy>"
      "<core:cityObjectMember><luse:LandUse><luse:lod1MultiSurface><gml:MultiSurface>" +
      surface(
          "35.679 139.749 30 35.679 139.752 30 35.682 139.752 30 35.682 139.749 30 "
          "35.679 139.749 30") +
      "</gml:MultiSurface></luse:lod1MultiSurface></luse:LandUse></core:cityObjectMember>";
  for (const char* latitude : {"35.6801", "35.6805"})
    text +=
        "<core:cityObjectMember><veg:SolitaryVegetationObject><veg:height uom=\"m\">9"
        "</veg:height><veg:lod2ImplicitRepresentation><core:ImplicitGeometry>"
        "<core:transformationMatrix>1 0 0 5 0 1 0 5 0 0 1 0 0 0 0 1"
        "</core:transformationMatrix><core:relativeGMLGeometry><gml:MultiSurface>" +
        surface("-1 0 0 1 0 0 1 0 9 -1 0 0") +
        "</gml:MultiSurface></core:relativeGMLGeometry><core:referencePoint><gml:Point>"
        "<gml:pos>" +
        std::string(latitude) +
        " 139.75 30</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry>"
        "</veg:lod2ImplicitRepresentation></veg:SolitaryVegetationObject>"
        "</core:cityObjectMember>";
  const TempFolder folder;
  std::ofstream(folder / "town.gml") << text << "</core:CityModel>";
  const Shown shown = bake_town(folder.path(), "[ground]\nhorizon = false\n");
  EXPECT_EQ(shown.trunks, 2u);
  EXPECT_EQ(shown.vegetation_triangles, 0u);
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

TEST(BakeModelTrees, EachTreeIsAFeatureThatItsTrunkAndCrownName) {
  const TempFolder folder;
  const std::size_t trees = write_planted_town(folder.path()).trees;
  bake(read_recipe(write_recipe(folder.path(), "")), folder / "out");
  const Scene scene = read_scene(folder / "out/city.glb");
  for (const char* part : {"trunks", "crowns"}) {
    std::set<std::string> ids;
    for (const SceneNode& node : scene.nodes)
      if (node.name == part)
        for (const SceneInstance& tree : node.instances) {
          ASSERT_LT(tree.feature, scene.features.size());
          EXPECT_EQ(scene.features[tree.feature].type, "SolitaryVegetationObject");
          ids.insert(scene.features[tree.feature].id);
        }
    EXPECT_EQ(ids.size(), trees) << part;
    EXPECT_FALSE(ids.contains(""));
  }
}

// A city of nothing but `members`, in its plane.
fs::path write_plants(const TempFolder& folder, const std::string& members) {
  std::ofstream(folder / "plants.gml")
      << "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
         "xmlns:veg=\"http://www.opengis.net/citygml/vegetation/2.0\" "
         "xmlns:gml=\"http://www.opengis.net/gml\"><gml:boundedBy><gml:Envelope "
         "srsName=\"EPSG:25833\" srsDimension=\"3\"><gml:lowerCorner>389990 5819990 30"
         "</gml:lowerCorner><gml:upperCorner>390100 5820100 40</gml:upperCorner></gml:Envelope>"
         "</gml:boundedBy>"
      << members << "</core:CityModel>";
  std::ofstream(folder / "plants.toml") << "[city]\nfiles = ['plants.gml']\n";
  return folder / "plants.toml";
}

TEST(BakeModelTrees, ACityOfTreesAloneIsAScene) {
  const TempFolder folder;
  const fs::path recipe = write_plants(
      folder,
      "<core:cityObjectMember><veg:SolitaryVegetationObject gml:id=\"oak\"><veg:height "
      "uom=\"m\">14</veg:height><veg:lod1ImplicitRepresentation><core:ImplicitGeometry>"
      "<core:referencePoint><gml:Point><gml:pos srsDimension=\"3\">390000 5820000 35</gml:pos>"
      "</gml:Point></core:referencePoint></core:ImplicitGeometry>"
      "</veg:lod1ImplicitRepresentation></veg:SolitaryVegetationObject></core:cityObjectMember>");
  bake(read_recipe(recipe), folder / "out");
  const Scene scene = read_scene(folder / "out/city.glb");
  ASSERT_EQ(scene.features.size(), 1u);
  EXPECT_EQ(scene.features[0].id, "oak");
  for (const SceneNode& node : scene.nodes) {
    ASSERT_EQ(node.instances.size(), 1u);
    EXPECT_EQ(node.instances[0].feature, 0u);
  }
  EXPECT_EQ(scene.nodes.size(), 2u) << "a trunk and a crown";
}

// A cover of 70 m by 70 m, flat but for its height.
std::string make_cover(const char* id, double height_m) {
  return std::string("<core:cityObjectMember><veg:PlantCover gml:id=\"") + id +
         "\"><veg:averageHeight uom=\"m\">" + std::to_string(height_m) +
         "</veg:averageHeight><veg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>"
         "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList srsDimension=\"3\">"
         "390000 5820000 35 390070 5820000 35 390070 5820070 35 390000 5820070 35 390000 5820000 35"
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>"
         "</gml:MultiSurface></veg:lod2MultiSurface></veg:PlantCover></core:cityObjectMember>";
}

TEST(BakeModelTrees, ACoverOfPlantsIsGrassScrubOrAWoodByItsHeight) {
  for (const auto& [height_m, material] :
       {std::pair{0.4, "grass"}, {2.0, "scrub"}, {12.0, "leaves"}}) {
    const TempFolder folder;
    bake(read_recipe(write_plants(folder, make_cover("cover", height_m))), folder / "out");
    const Scene scene = read_scene(folder / "out/city.glb");
    std::size_t shown = 0, crowns = 0;
    for (const SceneNode& node : scene.nodes) {
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        shown += scene.materials[primitive.material].name == material;
      if (node.name == "crowns") crowns = node.instances.size();
    }
    EXPECT_EQ(shown, 1u) << material;
    EXPECT_EQ(crowns > 50 && crowns <= 121, height_m > 3) << "one in a square of 7 m";
    ASSERT_EQ(scene.features.size(), 1u);
    EXPECT_EQ(scene.features[0].id, "cover");
  }
}

}  // namespace
}  // namespace nightcity::bake
