// Whole bakes of real places.
#include <gtest/gtest.h>

#include "formats/light_file.h"
#include "formats/scene_reader.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/bake/bake.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

TEST(BakeReal, BerlinsLampsStandOnItsGround) {
  REAL_DATA(city, "berlin/3910_5819.gml");
  REAL_DATA(map, "berlin/berlin_dev_box.osm.pbf");
  const TempFolder folder;
  Recipe recipe;
  recipe.city.files = {city};
  recipe.osm.files = {map};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.city.objects.at("building"), 35u);
  EXPECT_GE(report.lights.lamps.placed, 29u);  // those inside the buildings' box
  const LightFile lights = LightFile::open(folder / "out/city.lights");
  lights.verify();
  EXPECT_EQ(lights.lights().size(), report.lights.lamps.placed + report.lights.windows.placed);
  EXPECT_GT(report.lights.windows.placed, 100u);
  for (std::size_t i = 0; i < report.lights.lamps.placed; ++i) {  // lamps come first
    const Light& light = lights.lights()[i];
    // Berlin's Mitte lies at 34 m; luminaires hang 3 to 20 m above.
    const double height = lights.georeference().from_model(glm::dvec3(light.position)).z;
    EXPECT_GT(height, 30);
    EXPECT_LT(height, 70);
  }
  const Scene scene = read_scene(folder / "out/city.glb");
  EXPECT_EQ(scene.features.size(), 35u + report.gaps.buildings);
  EXPECT_EQ(scene.georeference.crs, "EPSG:25833");
}

TEST(BakeReal, FilesOfTwoCrsFormsMeetInOneFrame) {
  REAL_DATA(one, "berlin/3900_5820.gml");                           // urn:ogc:def:crs:EPSG::25833
  REAL_DATA(other, "berlin/berlin_open_data_sample_data.citygml");  // EPSG:25833
  const TempFolder folder;
  Recipe recipe;
  recipe.city.files = {one, other};
  bake(recipe, folder / "out");
  const Scene scene = read_scene(folder / "out/city.glb");
  for (const SceneNode& node : scene.nodes)
    EXPECT_LT(glm::length(glm::vec3(node.instances.at(0).to_model[3])), 3000);
}

TEST(BakeReal, DegreesBecomeMetres) {
  REAL_DATA(city, "plateau/53392547_bldg_6697_op2.gml");
  const TempFolder folder;
  Recipe recipe;
  recipe.city.files = {city};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.city.objects.at("building"), 25u);
  // 139.7125 to 139.7156 degrees of longitude at 35.54 north are about 280 m; 35.5407 to 35.5423 of
  // latitude 178 m.
  const Scene scene = read_scene(folder / "out/city.glb");
  glm::vec3 least(1e9f), greatest(-1e9f);
  for (const SceneNode& node : scene.nodes) {
    if (node.kind != "city") continue;
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      for (const glm::vec3& p : primitive.positions) {
        const glm::vec3 place(node.instances.at(0).to_model * glm::vec4(p, 1));
        least = glm::min(least, place);
        greatest = glm::max(greatest, place);
      }
  }
  EXPECT_NEAR(greatest.x - least.x, 281, 15);
  EXPECT_NEAR(greatest.z - least.z, 178, 15);
}

}  // namespace
}  // namespace nightcity::bake
