// The origin that scenes are rendered about: model space's own, or the middle of what lies far
// away.
#include "runtime/scene/local_origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/scene/camera.h"
#include "tests/support/scenes.h"

namespace nightcity::scene {
namespace {

using test::lamp;
using test::SceneBuilder;

glm::dvec3 origin_of(const SceneBuilder& builder, const std::vector<Light>& lights = {}) {
  return find_local_origin(builder.scene(), meshes_of(builder.scene()), lights);
}

void move_to(SceneBuilder& builder, const glm::dvec3& place) {
  SceneInstance& instance = builder.scene().nodes[0].instances[0];
  instance.to_model[3] = glm::vec4(glm::vec3(place), 1);
  instance.translation_rest = glm::vec3(place - glm::dvec3(instance.to_model[3]));
}

TEST(LocalOrigin, IsThatOfModelSpaceWhereTheSceneComesNearIt) {
  EXPECT_EQ(origin_of(SceneBuilder()), glm::dvec3(0)) << "nothing to see";
  EXPECT_EQ(origin_of(SceneBuilder().ground(50)), glm::dvec3(0));
  EXPECT_EQ(origin_of(SceneBuilder().ground(1e7f)), glm::dvec3(0));
  SceneBuilder near;
  near.ground(50);
  move_to(near, {15'000, 0, -15'000});
  EXPECT_EQ(origin_of(near), glm::dvec3(0));
  EXPECT_EQ(origin_of(SceneBuilder().ground(50), {lamp({1e8f, 1e8f, 0}, 1)}), glm::dvec3(0))
      << "a far lamp over a near ground";
}

TEST(LocalOrigin, IsTheMiddleOfASceneFarAway) {
  SceneBuilder far;
  far.ground(50);
  move_to(far, {412'345.678, 55, -5'762'000.25});
  const glm::dvec3 origin = origin_of(far, {lamp({412345, 60, -5762000}, 1)});
  EXPECT_EQ(origin, glm::dvec3(403 * 1024, 0, -5627 * 1024));
}

// A tower that was placed wrongly at the origin, beside a hundred at their place; and one lamp in a
// hundred that stands at the origin keeps it there.
TEST(LocalOrigin, FollowsAllButAFewThings) {
  SceneBuilder city;
  city.box({0, 0, 0}, {10, 30, 10});
  std::vector<SceneInstance>& towers = city.scene().nodes[0].instances;
  for (int i = 0; i < 100; ++i) {
    SceneInstance tower;
    tower.to_model[3] = {1e6f + 20 * float(i), 0, 0, 1};
    towers.push_back(tower);
  }
  towers.push_back(towers.back());
  EXPECT_NEAR(origin_of(city).x, 1e6, 1600);
  std::vector<Light> lamps(99, lamp({1e6f, 5, 0}, 1));
  lamps.push_back(lamp({0, 5, 0}, 1));
  EXPECT_EQ(origin_of(city, lamps), glm::dvec3(0));
}

TEST(LocalOrigin, PassesOverWhatIsNotFinite) {
  SceneBuilder far;
  far.ground(50);
  move_to(far, {1e6, 0, 0});
  far.scene().nodes.push_back(far.scene().nodes[0]);
  far.scene().nodes.back().instances[0].to_model[3].x = std::numeric_limits<float>::infinity();
  EXPECT_NEAR(origin_of(far, {lamp({std::nanf(""), 0, 0}, 1)}).x, 1e6, 1024);
}

// Corners, lights and cameras at 10,000 km keep a tenth of a millimetre.
TEST(LocalOrigin, KeepsMillimetresTenThousandKilometresAway) {
  const glm::dvec3 place(1e7 + 0.125, 35.4321, -1e7 - 0.375);
  SceneBuilder far;
  far.quad({-1.5f, 0, -1.5f}, {-1.5f, 0, 1.5f}, {1.5f, 0, 1.5f}, {1.5f, 0, -1.5f});
  move_to(far, place);
  const RenderScene scene = far.with({lamp({1e7f, 40, -1e7f}, 100)});
  const auto in_model = [&](const glm::vec3& p) { return glm::dvec3(p) + scene.origin; };
  EXPECT_LT(glm::distance(in_model(scene.triangles[0].v0), place + glm::dvec3(-1.5, 0, -1.5)),
            1e-4);
  EXPECT_LT(glm::distance(in_model(scene.lights.at(0).position), glm::dvec3(1e7, 40, -1e7)), 1e-4);
  EXPECT_LT(glm::distance(scene.georeference.from_model(glm::dvec3(scene.lights.at(0).position)),
                          glm::dvec3(1e7, 1e7, 40)),
            1e-4);
  const std::string text =
      R"({"fov_deg":60.0,"position":[10000000.0123,30.5,-10000000.5],"target":[10000001.0,30.5,-1e7]})";
  const CameraPose pose = find_camera(text, scene);
  EXPECT_LT(glm::distance(in_model(pose.position), glm::dvec3(1e7 + 0.0123, 30.5, -1e7 - 0.5)),
            1e-4);
  const CameraPose again = find_camera(to_text(pose), scene);
  EXPECT_EQ(again.position, pose.position);
  const CameraPose elsewhere = relative_to(scene.origin + glm::dvec3(1024, 0, 0), pose);
  EXPECT_EQ(elsewhere.position, pose.position - glm::vec3(1024, 0, 0));
}

}  // namespace
}  // namespace nightcity::scene
