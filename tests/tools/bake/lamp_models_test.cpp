#include "tools/bake/scene/lamp_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tools/bake/scene/materials.h"

namespace nightcity::bake {
namespace {

lights::PlacedLamp lamp(double east, double flux) {
  lights::PlacedLamp result;
  result.foot = {391000 + east, 5819000, 35};
  result.mounting_height_m = 8;
  result.outreach = {0, 1.5};
  result.aim = {0, 1};
  result.flux_lm = flux;
  result.colour = {1.2f, 1.0f, 0.6f};
  result.radius_m = 0.1;
  return result;
}

Scene written(const std::vector<lights::PlacedLamp>& lamps) {
  const test::TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  const std::uint32_t post = writer.add_material({.name = "post"});
  const Georeference georeference{"EPSG:25833", {391000, 5819000, 35}, {}, {}};
  add_lamp_models(writer, lamps, georeference, post);
  writer.finish(georeference);
  return read_scene(folder / "city.glb");
}

const SceneNode* node_named(const Scene& scene, const std::string& name) {
  for (const SceneNode& node : scene.nodes)
    if (node.name == name) return &node;
  return nullptr;
}

TEST(LampModels, OfAWholeCityEveryLampHasOnePostAndShowsItsOwnLight) {
  std::vector<lights::PlacedLamp> lamps;
  for (int n = 0; n < 20'000; ++n) {
    lamps.push_back(lamp(n / 2, n % 3 == 0 ? 5000 : 3000));  // two luminaires a post
    if (n % 2) lamps.back().outreach = {0, -1.5};
  }
  const Scene scene = written(lamps);
  std::vector<int> shown(lamps.size(), 0);
  std::size_t posts = 0, housings = 0;
  for (const SceneNode& node : scene.nodes) {
    if (node.name == "lamp posts") posts += node.instances.size();
    if (node.name == "lamp housings") housings += node.instances.size();
    if (node.name != "luminaires") continue;
    for (const SceneInstance& instance : node.instances) {
      ASSERT_LT(instance.light, shown.size());
      ++shown[instance.light];
      EXPECT_NEAR(instance.to_model[3].x, static_cast<float>(instance.light / 2), 1e-2f);
    }
  }
  EXPECT_EQ(shown, std::vector<int>(lamps.size(), 1));
  EXPECT_EQ(posts, lamps.size() / 2);
  EXPECT_EQ(housings, lamps.size());
  EXPECT_EQ(scene.meshes.size(), 5u) << "a post, an arm, a housing and two looks of balls";
}

TEST(LampModels, StandOnTheirFeetAndReachOverTheRoad) {
  const Scene scene = written({lamp(20, 5000)});
  const SceneNode* posts = node_named(scene, "lamp posts");
  const SceneNode* arms = node_named(scene, "lamp arms");
  const SceneNode* balls = node_named(scene, "luminaires");
  ASSERT_TRUE(posts && arms && balls);
  const glm::mat4& post = posts->instances.at(0).to_model;
  EXPECT_LT(glm::distance(glm::vec3(post * glm::vec4(0, 0, 0, 1)), {20, 0, 0}), 1e-4f);
  EXPECT_NEAR((post * glm::vec4(0, 1, 0, 1)).y, 8, 0.1);
  // The arm runs from the post's top northward, which is -z, to the luminaire.
  const glm::vec4 end = arms->instances.at(0).to_model * glm::vec4(1, 0, 0, 1);
  EXPECT_NEAR(end.x, 20, 1e-4);
  EXPECT_NEAR(end.z, -1.5, 1e-4);
  const glm::vec3 centre(balls->instances.at(0).to_model[3]);
  EXPECT_LT(glm::distance(centre, {20, 8, -1.5f}), 1e-4f);
}

TEST(LampModels, APostWithoutArmEndsUnderItsLight) {
  for (const double reach : {0.0, 0.01, 0.1}) {
    lights::PlacedLamp lantern = lamp(0, 800);
    lantern.outreach = {reach, 0};
    const Scene scene = written({lantern});
    const glm::mat4& post = node_named(scene, "lamp posts")->instances.at(0).to_model;
    EXPECT_LT((post * glm::vec4(0, 1, 0, 1)).y, 8 - 0.1) << reach;
    EXPECT_EQ(node_named(scene, "lamp arms"), nullptr);
  }
}

TEST(LampModels, OnlyWhatAProfileHoldsCastsNoShadow) {
  const Scene scene = written({lamp(0, 5000)});
  EXPECT_TRUE(node_named(scene, "lamp posts")->casts_shadow);
  EXPECT_TRUE(node_named(scene, "lamp arms")->casts_shadow);
  EXPECT_FALSE(node_named(scene, "lamp housings")->casts_shadow);
  EXPECT_FALSE(node_named(scene, "luminaires")->casts_shadow);
  for (const SceneNode& node : scene.nodes) EXPECT_EQ(node.kind, "lamp");
}

TEST(LampModels, EachBallNamesItsLightAndEmitsItsFlux) {
  std::vector<lights::PlacedLamp> lamps;
  for (int i = 0; i < 10; ++i) lamps.push_back(lamp(i * 10, i % 3 ? 5000 : 9000));
  const Scene scene = written(lamps);
  std::map<std::uint32_t, double> flux_of;
  for (const SceneNode& node : scene.nodes)
    for (const SceneInstance& instance : node.instances) {
      if (instance.light == no_id) continue;
      const glm::dvec3 e(
          scene.materials[scene.meshes[node.mesh].primitives.at(0).material].emission_cd_m2);
      const double radius = double{glm::length(glm::vec3(instance.to_model[0]))};
      // The colour's luminance is 1.2 * 0.2126 + 0.7152 + 0.6 * 0.0722, not 1: compare by the green
      // channel, which is 1.
      flux_of[instance.light] = e.y * 4 * std::numbers::pi * std::numbers::pi * radius * radius;
      EXPECT_NEAR(instance.to_model[3].x, lamps[instance.light].foot.x - 391000, 1e-3);
    }
  ASSERT_EQ(flux_of.size(), lamps.size());
  for (const auto& [light, flux] : flux_of) EXPECT_NEAR(flux / lamps[light].flux_lm, 1, 1e-5);
}

TEST(LampModels, SurfacesFaceOutward) {
  const Scene scene = written({lamp(0, 5000)});
  for (const char* name : {"luminaires", "lamp arms", "lamp housings", "lamp posts"}) {
    const SceneNode* node = node_named(scene, name);
    const ScenePrimitive& p = scene.meshes[node->mesh].primitives.at(0);
    glm::vec3 centre(0);
    for (const glm::vec3& v : p.positions) centre += v / static_cast<float>(p.positions.size());
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
      const glm::vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]],
                      c = p.positions[p.indices[i + 2]];
      EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a - centre), 0) << name << " " << i / 3;
    }
  }
}

TEST(LampModels, LuminairesOnOnePostShareIt) {
  lights::PlacedLamp other_side = lamp(0, 5000);
  other_side.outreach = -other_side.outreach;
  const Scene scene = written({lamp(0, 5000), other_side});
  EXPECT_EQ(node_named(scene, "lamp posts")->instances.size(), 1u);
  EXPECT_EQ(node_named(scene, "lamp arms")->instances.size(), 2u);
}

TEST(Materials, HaveTheAlbedoOfTheTableAsLuminance) {
  for (const SceneMaterial& material : bake_materials()) {
    const glm::vec3 c = material.base_colour;
    const float albedo = 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
    EXPECT_GE(albedo, 0.03f) << material.name;
    EXPECT_LE(albedo, 0.6f) << material.name;
    EXPECT_LE(std::max({c.x, c.y, c.z}), 1.0f) << material.name;
  }
}

}  // namespace
}  // namespace nightcity::bake
