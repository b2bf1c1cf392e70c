#include "runtime/scene/render_scene.h"

#include <gtest/gtest.h>

#include <cstring>

#include "formats/error.h"
#include "formats/light_file_writer.h"
#include "formats/scene_reader.h"
#include "formats/scene_samples.h"
#include "formats/scene_writer.h"
#include "runtime/scene/trace_ray.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::test {
namespace {

std::string message_of(const std::filesystem::path& scene) {
  try {
    scene::load_render_scene(scene);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

// Writes a square with one lamp; `name` becomes the source's name, and so part of the identity.
void write_scene(const TempFolder& folder, const std::string& name, const char* source) {
  Georeference georeference{"EPSG:25833", {391000, 5819000, 30}, {source}, {}};
  LightFileWriter lights(folder / (name + ".lights"));
  lights.add(lamp({0, 5, 0}, 1000), {});
  georeference.scene_id = lights.scene_id(georeference);
  lights.finish({.georeference = georeference});
  SceneWriter scene(folder / (name + ".glb"), {});
  scene.add_material({.name = "road"});
  ScenePrimitive square;
  square.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
  square.indices = {0, 1, 2};
  scene.add_node({"road", "road", scene.add_mesh({"road", {square}}), true, {SceneInstance{}}});
  scene.finish(georeference);
}

TEST(LoadRenderScene, RefusesTheLightsOfAnotherScene) {
  const TempFolder folder;
  write_scene(folder, "a", "one.gml");
  write_scene(folder, "b", "other.gml");
  EXPECT_EQ(message_of(folder / "a.glb"), "");
  std::filesystem::copy_file(folder / "b.lights", folder / "a.lights",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string message = message_of(folder / "a.glb");
  EXPECT_NE(message.find("a.glb"), std::string::npos) << message;
  EXPECT_NE(message.find("a.lights"), std::string::npos) << message;
  EXPECT_NE(message.find("another scene"), std::string::npos) << message;
}

TEST(LoadRenderScene, RefusesALightFileWithAWrongByte) {
  const TempFolder folder;
  write_scene(folder, "a", "one.gml");
  std::string bytes = read_text(folder / "a.lights");
  bytes[64 + 46] = '\x47';  // the first light's flux
  write_text(folder / "a.lights", bytes);
  EXPECT_NE(message_of(folder / "a.glb").find("checksum"), std::string::npos);
}

// Triangles that are read in place and those that are not: of instances, moved and turned, and with
// one without area among them.
TEST(LoadRenderScene, GivesTheTrianglesThatReadSceneHas) {
  const TempFolder folder;
  SceneWriter writer(folder / "a.glb", {});
  writer.add_material({.name = "road"});
  writer.add_material({.name = "wall"});
  ScenePrimitive flat = field(40, 1);
  for (std::size_t k = 0; k < 3; ++k) flat.indices[30 + k] = 5;
  SceneInstance moved, turned;
  moved.to_model[3] = {1000.25f, 3, -2, 1};
  turned.to_model[0] = {0, 0, -2, 0};
  turned.to_model[2] = {2, 0, 0, 0};
  writer.add_node({"a", "road", writer.add_mesh({"a", {field(300), field(7, 1)}}), true, {moved}});
  writer.add_node({"b", "road", writer.add_mesh({"b", {flat, field(9)}}), false, {turned}});
  writer.add_node({"c", "lamp", writer.add_mesh({"c", {square(2)}}), true, {moved, turned}});
  // Copies that are lights, or objects of their own, are read in place as well.
  moved.light = 3;
  turned.feature = writer.add_feature({.id = "d"});
  writer.add_node({"d", "lamp", writer.add_mesh({"d", {field(10)}}), true, {moved, turned}});
  writer.finish({});

  scene::RenderScene loaded = scene::load_render_scene(folder / "a.glb"),
                     made = scene::make_render_scene(read_scene(folder / "a.glb"), {});
  EXPECT_EQ(loaded.dropped_triangles, 1u);
  EXPECT_EQ(made.dropped_triangles, 1u);
  ASSERT_EQ(loaded.triangles.size(), 2 * (300 + 7 + 40 + 9 + 2 + 20) - 1u)
      << "two copies of c and d";
  EXPECT_EQ(loaded.triangles.stored().size(), 2 * (40 + 2) - 1u) << "of b and c";
  ASSERT_EQ(loaded.triangles.size(), made.triangles.size());
  for (std::size_t i = 0; i < made.triangles.size(); ++i) {
    const gpu::Triangle a = loaded.triangles[i], b = made.triangles[i];
    ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0) << i;
  }
  ASSERT_EQ(loaded.nodes.size(), made.nodes.size());
  EXPECT_EQ(std::memcmp(loaded.nodes.data(), made.nodes.data(),
                        loaded.nodes.size() * sizeof loaded.nodes[0]),
            0);
  EXPECT_EQ(loaded.triangle_order, made.triangle_order);
  // Pages that were given back are read again, and a copy holds the file as well.
  const scene::RenderScene copy = loaded;
  copy.triangles.release_pages();
  std::filesystem::remove(folder / "a.glb");
  EXPECT_EQ(copy.triangles[5].v1, made.triangles[5].v1);
}

// Cameras and grids are made for the city, and rays still meet the ground around it.
TEST(RenderScene, IsFramedWithoutTheHorizon) {
  SceneBuilder builder;
  Scene scene = builder.ground(50).scene();
  scene.meshes.push_back({"horizon", {ScenePrimitive{}}});
  ScenePrimitive& ring = scene.meshes[1].primitives[0];
  ring.positions = {{50, 0, -30000}, {50, 0, 30000}, {30000, -100, 0}};
  ring.indices = {0, 1, 2};
  scene.nodes.push_back({"horizon", "horizon", 1, false, {SceneInstance{}}});
  const scene::RenderScene with = scene::make_render_scene(scene, {});
  EXPECT_NEAR(with.bounds.upper.x, 50, 0.01);
  EXPECT_NEAR(with.root_box.upper.x, 50, 0.01);
  EXPECT_EQ(with.horizon.lower, glm::vec2(with.bounds.lower.x, with.bounds.lower.z));
  EXPECT_NEAR(with.horizon.upper.x, 50, 0.01) << "the rectangle without any of it";
  EXPECT_NEAR(with.horizon.top, 0, 0.1);
  EXPECT_TRUE(scene::trace_ray(with, {1000, 5, 10}, {0, -1, 0}, 1000, MASK_VISIBLE));
  EXPECT_FALSE(scene::trace_ray(with, {1000, 5, 10}, {0, -1, 0}, 1000, MASK_SHADOW));
  EXPECT_TRUE(scene::trace_ray(with, {10, 5, 10}, {0, -1, 0}, 1000, MASK_SHADOW));
}

bool says(const std::vector<std::string>& sentences, const std::string& words) {
  for (const std::string& sentence : sentences)
    if (sentence.find(words) != std::string::npos) return true;
  return false;
}

TEST(DescribeLeftOut, NamesWhatNoPictureShows) {
  SceneBuilder builder;
  builder.ground(10).quad({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  builder.scene().skipped = {"a thing"};
  builder.scene().nodes.push_back({"flat", "", 0, true, {SceneInstance{}, SceneInstance{}}});
  builder.scene().nodes.back().instances[1].to_model[0][0] = 0;
  Light dark = lamp({0, 5, 0}, 1000);
  dark.flux_lm = 0;
  const auto sentences = scene::describe_left_out(builder.with({dark}));
  EXPECT_TRUE(says(sentences, "a thing"));
  EXPECT_TRUE(says(sentences, "without area"));
  EXPECT_TRUE(says(sentences, "1 instance is left out"));
  EXPECT_TRUE(says(sentences, "1 light is switched off"));
  EXPECT_TRUE(scene::describe_left_out(SceneBuilder().ground(10).with({})).empty());
  EXPECT_TRUE(scene::describe_left_out(scene::RenderScene{}).empty());
}

TEST(DescribeLeftOut, WarnsOfAWideSceneAndOfLightsFarFromTheFilesOrigin) {
  EXPECT_TRUE(says(scene::describe_left_out(SceneBuilder().ground(50'000).with({})),
                   "reaches 50 km from its origin"));
  SceneBuilder builder;
  builder.ground(100);
  builder.scene().nodes[0].instances[0].to_model[3] = {391000, 34, -5819000, 1};
  EXPECT_TRUE(scene::describe_left_out(builder.with({})).empty());
  const Light far = lamp({391000, 40, -5819000}, 1000);
  EXPECT_TRUE(says(scene::describe_left_out(builder.with({far})),
                   "lies 5819 km from the origin of its files, where places of lights are rounded "
                   "to 0.5"));
}

}  // namespace
}  // namespace nightcity::test
