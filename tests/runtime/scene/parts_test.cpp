// A scene without some of its parts: what is gone, what stays, and what is counted.
#include "runtime/scene/parts.h"

#include <gtest/gtest.h>

#include <cstring>

#include "support/scenes.h"

namespace nightcity::scene {
namespace {

using test::lamp;
using test::SceneBuilder;
using test::window;

PartSet only(Part part) {
  PartSet set;
  set.set(static_cast<std::size_t>(part));
  return set;
}

std::size_t count_of(const RenderScene& scene, Part part) {
  return scene.parts[static_cast<std::size_t>(part)];
}

// A ground; a window with a pane that names it; a lamp with a profile that looks aslant, with a
// luminous ball; a schedule; a tree.
struct Town {
  SceneBuilder builder;
  SceneLights lights;

  Town() {
    builder.ground(10);
    add_mesh("window", 0, no_id, false);
    add_mesh("lamp", no_id, 1, false);
    add_mesh("tree", no_id, no_id, true);
    lights.lights = {window({0, 2, -5}, {0, 0, 1}, 1, 1, 300), lamp({2, 5, 0}, 4000, 0.1f)};
    lights.families = {LightFamily::window, LightFamily::lamp};
    lights.profiles = {{1, 2, 0, 90}};
    lights.profile_data = {1, 1};
    lights.lights[1].kind_profile = pack_kind_profile(LightKind::sphere, 0);
    lights.lights[1].axis = {0.6f, -0.8f, 0};
    lights.lights[1].tangent = {0.8f, 0.6f, 0};
    lights.schedules = {{0, 1}};
    lights.switches = {18000};
    lights.lights[0].schedule = 0;
  }
  // Adds a triangle as a node of this kind. `vertices` is the light that its vertices name,
  // `instance` the one that its placement names.
  void add_mesh(const char* kind, std::uint32_t vertices, std::uint32_t instance, bool shadow) {
    Scene& scene = builder.scene();
    ScenePrimitive triangle;
    triangle.positions = {{0, 1, -5}, {1, 1, -5}, {0, 2, -5}};
    triangle.indices = {0, 1, 2};
    if (vertices != no_id) triangle.light_ids = {vertices, vertices, vertices};
    scene.meshes.push_back({kind, {triangle}});
    SceneInstance placed;
    placed.light = instance;
    scene.nodes.push_back(
        {kind, kind, static_cast<std::uint32_t>(scene.meshes.size() - 1), shadow, {placed}});
  }
  RenderScene make(const PartSet& left_out = {}) const {
    return make_render_scene(builder.scene(), lights, left_out);
  }
};

TEST(Parts, AreCountedWhetherTheyAreLeftOutOrNot) {
  PartSet all;
  all.set();
  for (const PartSet& left_out : {PartSet(), all}) {
    const RenderScene scene = Town().make(left_out);
    for (const Part part : {Part::windows, Part::profiles, Part::aim, Part::lamp_sizes,
                            Part::schedules, Part::lamp_bodies, Part::trees})
      EXPECT_EQ(count_of(scene, part), 1u) << int(part);
    for (const Part part : {Part::traffic, Part::vehicle_shadows, Part::colours, Part::water})
      EXPECT_EQ(count_of(scene, part), 0u) << int(part);
  }
}

TEST(Parts, WithoutWindowsPanesAreGoneAndOtherSurfacesKeepTheirLamps) {
  const RenderScene whole = Town().make(), scene = Town().make(only(Part::windows));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].flux_lm, 4000);
  EXPECT_EQ(scene.families[0], LightFamily::lamp);
  EXPECT_EQ(scene.triangles.size() + 1, whole.triangles.size());
  // The ball of the lamp is an instance, or its one triangle is copied.
  std::size_t balls = 0;
  const auto count = [&](std::uint32_t light) {
    if (light == NO_HIT) return;
    ++balls;
    EXPECT_EQ(light, 0u) << "the lamp is the first light now";
  };
  for (const gpu::Triangle& triangle : scene.triangles) count(triangle.light);
  for (const gpu::Instance& instance : scene.instances) count(instance.light);
  EXPECT_EQ(balls, 1u);
}

// In files of others a pane may be part of any node.
TEST(Parts, WithoutWindowsTrianglesThatNameOneAreGone) {
  Town town;
  town.builder.scene().nodes[1].kind = "";
  EXPECT_EQ(town.make(only(Part::windows)).triangles.size() + 1, town.make().triangles.size());
}

TEST(Parts, LampsBecomePointsWhoseBallsShineAsTheirMaterialSays) {
  const RenderScene scene = Town().make(only(Part::lamp_sizes));
  EXPECT_EQ(scene.lights[1].radius, 0);
  EXPECT_EQ(scene.lights[0].radius, 1) << "a window keeps its width";
  for (const gpu::Instance& instance : scene.instances) EXPECT_EQ(instance.light, NO_HIT);
  const std::uint32_t lamp = 1;
  for (const gpu::Triangle& triangle : scene.triangles) EXPECT_NE(triangle.light, lamp);
  EXPECT_EQ(scene.triangles.size(), Town().make().triangles.size());
}

TEST(Parts, ProfilesAimAndSchedulesGoOneByOne) {
  const RenderScene even = Town().make(only(Part::profiles));
  EXPECT_EQ(light_profile(even.lights[1]), LIGHT_NO_PROFILE);
  EXPECT_TRUE(even.profiles.empty());
  EXPECT_EQ(even.lights[1].flux_lm, 4000);
  const RenderScene straight = Town().make(only(Part::aim));
  EXPECT_EQ(straight.lights[1].axis, glm::vec3(0, -1, 0));
  EXPECT_EQ(glm::dot(straight.lights[1].axis, straight.lights[1].tangent), 0);
  EXPECT_EQ(straight.lights[0].axis, glm::vec3(0, 0, 1)) << "a window faces where it did";
  const RenderScene lit = Town().make(only(Part::schedules));
  EXPECT_TRUE(lit.schedules.empty());
  EXPECT_EQ(lit.lights[0].schedule, LIGHT_ALWAYS_ON);
}

TEST(Parts, BodiesOfLampsAndTreesGoAndTheirLightsStay) {
  for (const Part part : {Part::lamp_bodies, Part::trees}) {
    const RenderScene scene = Town().make(only(part));
    EXPECT_EQ(scene.triangles.size() + 1, Town().make().triangles.size());
    EXPECT_EQ(scene.lights.size(), 2u);
  }
}

TEST(Parts, OneGreyForAllIsTheMeanByArea) {
  SceneBuilder builder(0.2f);
  builder.ground(1);  // 4 m^2
  Scene& scene = builder.scene();
  scene.materials.push_back({"white", glm::vec3(0.8f), glm::vec3(0), 0.05f, true});
  ScenePrimitive roof;
  roof.material = 1;
  roof.positions = {{0, 5, 0}, {0, 5, 4}, {4, 5, 0}};  // 8 m^2
  roof.indices = {0, 1, 2};
  scene.meshes.push_back({"roof", {roof}});
  scene.nodes.push_back({"roof", "city", 1, true, {SceneInstance{}}});
  const RenderScene grey = make_render_scene(scene, {}, only(Part::colours));
  EXPECT_EQ(count_of(grey, Part::colours), 1u);
  for (const gpu::Material& material : grey.materials)
    EXPECT_NEAR(material.base_colour.x, (0.2 * 4 + 0.8 * 8) / 12, 1e-6);
  EXPECT_EQ(count_of(grey, Part::water), 1u);
  EXPECT_EQ(make_render_scene(scene, {}, only(Part::water)).materials[1].roughness, 1);
}

// Leaving out what a scene does not have changes nothing: every array keeps its bytes.
TEST(Parts, WhatIsAbsentCostsNothing) {
  SceneBuilder builder;
  builder.ground(10).box({-1, 0, -1}, {1, 3, 1});
  const std::vector<Light> lights{lamp({2, 5, 0}, 4000, 0)};
  const RenderScene whole = builder.with(lights);
  for (std::size_t part = 0; part < part_count; ++part) {
    ASSERT_EQ(whole.parts[part], 0u) << part;
    const RenderScene scene = make_render_scene(
        builder.scene(), {test::to_large(lights), {}, {}, {}}, PartSet().set(part));
    const auto same = [](const auto& a, const auto& b) {
      return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
    };
    // Whatever way the mean of equal colours is summed, it is the same to a part in 10^7.
    if (part != static_cast<std::size_t>(Part::colours)) {
      EXPECT_TRUE(same(scene.materials, whole.materials)) << part;
    }
    EXPECT_TRUE(same(scene.lights, whole.lights)) << part;
    const auto all = [](const TriangleList& list) {
      return std::vector<gpu::Triangle>(list.begin(), list.end());
    };
    EXPECT_TRUE(same(all(scene.triangles), all(whole.triangles))) << part;
    EXPECT_TRUE(same(scene.nodes, whole.nodes)) << part;
    EXPECT_TRUE(same(scene.instances, whole.instances)) << part;
  }
}

}  // namespace
}  // namespace nightcity::scene
