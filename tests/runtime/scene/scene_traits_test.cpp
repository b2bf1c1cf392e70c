// The traits that are known before a scene's geometry is read are those of the whole scene.
#include "runtime/scene/scene_traits.h"

#include <gtest/gtest.h>

#include <optional>

#include "support/scene_files.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::scene {
namespace {

using test::lamp;
using test::SceneBuilder;
using test::window;

// Reads a scene of these files, and returns what was expected of it. What is found in the end is
// the same.
SceneTraits expect_and_find(const SceneBuilder& builder, const LightFileContent& lights,
                            const PartSet& left_out = {}) {
  const test::TempFolder folder;
  SceneBuilder copy = builder;
  test::write_scene_files(folder / "a.glb", copy.scene(), lights);
  std::optional<SceneTraits> expected;
  const RenderScene loaded = load_render_scene(
      folder / "a.glb", left_out, [&](const SceneTraits& traits) { expected = traits; });
  EXPECT_TRUE(expected.has_value());
  EXPECT_EQ(*expected, find_traits(loaded));
  return *expected;
}

TEST(SceneTraits, AreKnownBeforeTheGeometry) {
  SceneBuilder builder;
  builder.ground(10);
  LightFileContent content;
  std::vector<Light> lights{lamp({2, 5, 0}, 4000, 0.1f)};
  std::vector<LightProvenance> provenance(1);
  lights[0].id = 1;
  content.lights = lights;
  content.provenance = provenance;
  EXPECT_EQ(expect_and_find(builder, content), SceneTraits{});

  lights.push_back(window({0, 2, -5}, {0, 0, 1}, 1, 1, 300));
  lights[1].id = 2;
  provenance.resize(2);
  std::vector<Schedule> schedules{{0, 1}};
  std::vector<std::uint32_t> switches{18000};
  lights[1].schedule = 0;
  content.lights = lights;
  content.provenance = provenance;
  content.schedules = schedules;
  content.switches = switches;
  // Bakes list the material of water whether or not there is any.
  SceneBuilder dry;
  dry.ground(10);
  dry.scene().materials.push_back({.name = "water", .roughness = 0});
  EXPECT_FALSE(expect_and_find(dry, content).water);
  SceneBuilder wet;
  wet.ground(10);
  wet.scene().materials[0].roughness = 0;
  EXPECT_EQ(expect_and_find(wet, content),
            (SceneTraits{.rectangles = true, .schedules = true, .water = true}));

  PartSet left_out;
  left_out.set(static_cast<std::size_t>(Part::water));
  left_out.set(static_cast<std::size_t>(Part::windows));
  EXPECT_EQ(expect_and_find(wet, content, left_out), SceneTraits{});
}

}  // namespace
}  // namespace nightcity::scene
