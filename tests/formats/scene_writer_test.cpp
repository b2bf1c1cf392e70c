#include "formats/scene_writer.h"
#include "formats/scene_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <span>
#include <string>

#include "formats/error.h"
#include "formats/scene_samples.h"
#include "support/make_png.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

using test::field;
using test::square;
using test::TempFolder;

Georeference berlin() {
  return {"EPSG:25833",
          {391000.25, 5819000.5, 34.125},
          {"a.gml"},
          {"OpenStreetMap contributors, ODbL 1.0"}};
}

TEST(SceneWriter, KeepsGeometryMaterialsFeaturesAndInstances) {
  const TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  writer.add_material({.name = "wall", .base_colour = {0.5f, 0.25f, 0.125f}, .roughness = 0.75f});
  writer.add_material(
      {.name = "lamp", .emission_cd_m2 = {1000, 20000, 500}, .double_sided = false});
  writer.add_feature({"house \"ü\"", "Building", "31001_1010", 12.5, 4});
  writer.add_feature({"road", "Road", "", {}, {}});
  SceneMesh mesh{"tile", {square(10), square(1, 1)}};
  mesh.primitives[0].feature_ids = {0, 0, 1, no_id};
  mesh.primitives[1].light_ids = {7, 7, no_id, 7};
  const auto tile = writer.add_mesh(mesh);
  writer.add_node(
      {"tile 0 0", "city", tile, true, {{glm::translate(glm::mat4(1), {100, 2, -50}), no_id}}});
  SceneNode lamps{"lamps", "lamp", tile, false, {}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    glm::mat4 place = glm::translate(glm::mat4(1), {float(i), 0, 0});
    place = glm::scale(glm::rotate(place, 0.5f * float(i), {0, 1, 0}), glm::vec3(1, 2, 1));
    lamps.instances.push_back({place, i == 1 ? no_id : i});
  }
  lamps.vehicle = 3;
  writer.add_node(lamps);
  writer.finish(berlin());

  const Scene scene = read_scene(folder / "city.glb");
  EXPECT_EQ(scene.georeference.crs, "EPSG:25833");
  EXPECT_EQ(scene.georeference.origin, berlin().origin);
  EXPECT_EQ(scene.georeference.sources, berlin().sources);
  EXPECT_EQ(scene.georeference.licences, berlin().licences);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].base_colour, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(scene.materials[0].emission_cd_m2, glm::vec3(0));
  EXPECT_EQ(scene.materials[0].roughness, 0.75f);
  EXPECT_TRUE(scene.materials[0].double_sided);
  EXPECT_FALSE(scene.materials[1].double_sided);
  EXPECT_NEAR(scene.materials[1].emission_cd_m2.x, 1000, 1e-3);
  EXPECT_NEAR(scene.materials[1].emission_cd_m2.y, 20000, 1e-3);
  ASSERT_EQ(scene.features.size(), 2u);
  EXPECT_EQ(scene.features[0].id, "house \"ü\"");
  EXPECT_EQ(scene.features[0].function, "31001_1010");
  EXPECT_EQ(scene.features[0].measured_height_m, 12.5);
  EXPECT_EQ(scene.features[0].storeys_above_ground, 4);
  EXPECT_EQ(scene.features[1].type, "Road");
  EXPECT_FALSE(scene.features[1].measured_height_m);
  EXPECT_FALSE(scene.features[1].storeys_above_ground);
  ASSERT_EQ(scene.meshes.size(), 1u);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(scene.meshes[0].primitives[p].positions, mesh.primitives[p].positions);
    EXPECT_EQ(scene.meshes[0].primitives[p].indices, mesh.primitives[p].indices);
    EXPECT_EQ(scene.meshes[0].primitives[p].feature_ids, mesh.primitives[p].feature_ids);
    EXPECT_EQ(scene.meshes[0].primitives[p].light_ids, mesh.primitives[p].light_ids);
  }
  ASSERT_EQ(scene.nodes.size(), 2u);
  EXPECT_EQ(scene.nodes[0].kind, "city");
  EXPECT_TRUE(scene.nodes[0].casts_shadow);
  EXPECT_EQ(scene.nodes[0].instances.at(0).to_model[3], glm::vec4(100, 2, -50, 1));
  EXPECT_EQ(scene.nodes[1].kind, "lamp");
  EXPECT_FALSE(scene.nodes[1].casts_shadow);
  EXPECT_EQ(scene.nodes[0].vehicle, no_id);
  EXPECT_EQ(scene.nodes[1].vehicle, 3u);
  ASSERT_EQ(scene.nodes[1].instances.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.nodes[1].instances[i].light, lamps.instances[i].light);
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r)
        EXPECT_NEAR(scene.nodes[1].instances[i].to_model[c][r], lamps.instances[i].to_model[c][r],
                    1e-6);
  }
}

TEST(SceneWriter, InstancesKeepTheObjectsThatTheyAre) {
  const TempFolder folder;
  SceneWriter writer(folder / "trees.glb", {});
  writer.add_material({});
  for (const char* id : {"oak", "lime", "house"}) writer.add_feature({id, "Tree", "", {}, {}});
  const auto mesh = writer.add_mesh({"crown", {square(1)}});
  const std::vector<std::uint32_t> objects{1, no_id, 0};
  SceneNode trees{"trees", "tree", mesh, true, {}};
  for (const std::uint32_t object : objects)
    trees.instances.push_back({glm::mat4(1), no_id, {}, object});
  writer.add_node(trees);
  writer.add_node({"one", "tree", mesh, true, {{glm::mat4(1), no_id, {}, 2}}});
  writer.add_node({"none", "tree", mesh, true, {{}}});
  SceneNode wrong{"wrong", "tree", mesh, true, {{glm::mat4(1), no_id, {}, 3}}};
  EXPECT_THROW(writer.add_node(wrong), Error);
  writer.finish({});
  const Scene scene = read_scene(folder / "trees.glb");
  ASSERT_EQ(scene.nodes.size(), 3u);
  for (std::size_t i = 0; i < objects.size(); ++i)
    EXPECT_EQ(scene.nodes[0].instances.at(i).feature, objects[i]);
  EXPECT_EQ(scene.nodes[1].instances.at(0).feature, 2u);
  EXPECT_EQ(scene.nodes[2].instances.at(0).feature, no_id);
  const std::string text = test::read_text(folder / "trees.glb");
  EXPECT_NE(text.find("\"EXT_instance_features\":{\"featureIds\":[{\"attribute\":0,"
                      "\"featureCount\":2,\"nullFeatureId\":8388607,\"propertyTable\":0}]}"),
            std::string::npos);
}

TEST(SceneWriter, HoldsMeshesOnBothSidesOf16BitIndices) {
  const TempFolder folder;
  for (const std::uint32_t squares : {16383u, 16384u}) {  // 65532 and 65536 vertices
    SceneWriter writer(folder / "big.glb", {});
    writer.add_material({});
    const SceneMesh mesh{"", {field(squares)}};
    writer.add_node({"", "city", writer.add_mesh(mesh), true, {{}}});
    writer.finish({});
    const Scene scene = read_scene(folder / "big.glb");
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).indices, mesh.primitives[0].indices);
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).positions, mesh.primitives[0].positions);
  }
}

TEST(SceneWriter, SameContentGivesTheSameBytes) {
  const TempFolder folder;
  const auto write = [&](const char* name, bool draco) {
    SceneWriter writer(folder / name, {.draco = draco});
    writer.add_material({});
    writer.add_node({"", "city", writer.add_mesh({"", {field(50)}}), true, {{}}});
    writer.finish(berlin());
    return test::read_text(folder / name);
  };
  EXPECT_EQ(write("a.glb", false), write("b.glb", false));
  EXPECT_EQ(write("c.glb", true), write("d.glb", true));
}

TEST(SceneWriter, LeavesNothingBehindWithoutFinish) {
  const TempFolder folder;
  {
    SceneWriter writer(folder / "city.glb", {});
    writer.add_material({});
    writer.add_mesh({"", {square(1)}});
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(SceneWriter, RefusesWhatNoReaderCouldUse) {
  const TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  writer.add_material({});
  const auto refused = [&](auto&& spoil) {
    SceneMesh mesh{"", {square(1)}};
    spoil(mesh.primitives[0]);
    EXPECT_THROW(writer.add_mesh(mesh), Error);
  };
  refused([](ScenePrimitive& p) { p.positions[2].y = std::numeric_limits<float>::quiet_NaN(); });
  refused([](ScenePrimitive& p) { p.positions[0].x = std::numeric_limits<float>::infinity(); });
  refused([](ScenePrimitive& p) { p.indices[5] = 4; });
  refused([](ScenePrimitive& p) { p.indices.pop_back(); });
  refused([](ScenePrimitive& p) { p.indices.clear(); });
  refused([](ScenePrimitive& p) { p.material = 1; });
  refused([](ScenePrimitive& p) { p.feature_ids = {0, 0, 0, 0}; });
  refused([](ScenePrimitive& p) { p.light_ids = {0, 0}; });
  EXPECT_THROW(writer.add_mesh({"empty", {}}), Error);
  const auto mesh = writer.add_mesh({"", {square(1)}});
  EXPECT_THROW(writer.add_node({"", "", mesh + 1, true, {{}}}), Error);
  glm::mat4 shear(1);
  shear[1][0] = 0.5f;
  EXPECT_THROW(writer.add_node({"", "", mesh, true, {{shear, no_id}}}), Error);
}

TEST(SceneWriter, NamesAPlaceThatCannotBeWritten) {
  const TempFolder folder;
  test::write_text(folder / "file", "x");
  EXPECT_THROW(SceneWriter(folder / "file/city.glb", {}), Error);
  EXPECT_THROW(SceneWriter(folder / "no/such/city.glb", {}), Error);
}

TEST(SceneWriter, KeepsPicturesTexturesAndTheirCoordinates) {
  const TempFolder folder;
  for (const bool draco : {false, true}) {
    SceneWriter writer(folder / "city.glb", {.draco = draco});
    const std::string png = test::make_rgb_png(2, 1, [](std::size_t x, std::size_t) {
      return std::array<unsigned char, 3>{255, static_cast<unsigned char>(x == 0 ? 255 : 0), 0};
    });
    const std::uint32_t picture = writer.add_picture(std::as_bytes(std::span(png)));
    writer.add_material({.name = "plain"});
    SceneMaterial material{.name = "wall"};
    material.texture = {.picture = picture,
                        .factor = {0.5f, 1, 1},
                        .wrap_u = TextureWrap::clamp,
                        .wrap_v = TextureWrap::mirror};
    writer.add_material(material);
    SceneMesh mesh{"tile", {square(10), square(5, 1)}};
    mesh.primitives[1].texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {-2.5f, 0}};
    writer.add_node({"tile", "city", writer.add_mesh(mesh), true, {SceneInstance{}}});
    writer.finish({});
    const Scene scene = read_scene(folder / "city.glb");
    EXPECT_TRUE(scene.skipped.empty());
    EXPECT_FALSE(scene.materials.at(0).texture);
    EXPECT_EQ(scene.materials.at(1).texture, material.texture);
    EXPECT_EQ(scene.materials[1].base_colour, glm::vec3(0.5f, 0.5f, 0));
    EXPECT_EQ(scene.pictures.at(0).size(), png.size());
    EXPECT_EQ(scene.meshes.at(0).primitives.at(1).texture_coordinates,
              mesh.primitives[1].texture_coordinates);
    EXPECT_EQ(scene.meshes[0].primitives[1].positions, mesh.primitives[1].positions);
  }
}

TEST(SceneWriter, RefusesTexturesThatPointToNothing) {
  const TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  SceneMaterial material;
  material.texture.emplace();
  EXPECT_THROW(writer.add_material(material), Error);
  EXPECT_THROW(writer.add_picture({}), Error);
  writer.add_material({});
  SceneMesh mesh{"tile", {square(10)}};
  mesh.primitives[0].texture_coordinates = {{0, 0}};
  EXPECT_THROW(writer.add_mesh(mesh), Error);
  mesh.primitives[0].texture_coordinates.assign(4, glm::vec2(NAN));
  EXPECT_THROW(writer.add_mesh(mesh), Error);
}

}  // namespace
}  // namespace nightcity
