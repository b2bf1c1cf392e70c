// The device's traversal against brute force in double.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "runtime/measure/metrics.h"
#include "runtime/scene/brute_force.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

render::RenderSettings plain() {
  return with_estimator(render::Estimator::ris, 1);
}

// Compares the depths of `scene` with those that brute force finds in `true_scene`.
void expect_depths_like(const scene::RenderScene& true_scene, const scene::RenderScene& scene,
                        const scene::CameraPose& pose, std::uint32_t side) {
  const measure::Image image = render(scene, pose, plain(), side, side, 1);
  const gpu::Camera camera = scene::make_camera(pose, 1.0f);
  const auto& depth = image.layer("depth")->values;
  int hits = 0, wrong = 0;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const double sx = (x + 0.5) / side * 2 - 1, sy = (y + 0.5) / side * 2 - 1;
      const glm::dvec3 direction =
          glm::normalize(glm::dvec3(camera.forward) +
                         glm::dvec3(camera.right) * (sx * double(camera.tan_half_height)) -
                         glm::dvec3(camera.up) * (sy * double(camera.tan_half_height)));
      const auto truth = scene::brute_force_hit(true_scene, glm::dvec3(camera.position), direction,
                                                1e30, MASK_VISIBLE);
      const double seen = double(depth[y * side + x]);
      if (truth) ++hits;
      if (truth.has_value() != (seen > 0) || (truth && std::abs(seen - *truth) > 1e-4 * *truth))
        ++wrong;
    }
  EXPECT_GT(hits, int(side * side / 8));
  // Rays that graze an edge may differ between float and double.
  EXPECT_LE(wrong, int(side * side / 500));
}

void expect_depths_like_brute_force(const scene::RenderScene& scene, const scene::CameraPose& pose,
                                    std::uint32_t side) {
  expect_depths_like(scene, scene, pose, side);
}

TEST(Traversal, PrimaryDepthsOfATownMatchBruteForce) {
  const scene::RenderScene scene = random_town(60, 60, 7).with({});
  expect_depths_like_brute_force(scene, {{-70, 35, 80}, {0, 5, 0}, {0, 1, 0}, 50}, 96);
}

TEST(Traversal, PrimaryDepthsOfATownAtAnAngleMatchBruteForce) {
  for (const float angle : {4.5f, 33.0f, 70.0f}) {
    const scene::RenderScene scene = turned(random_town(60, 60, 7), angle).with({});
    EXPECT_NE(scene.boxes_along, glm::vec2(1, 0));
    expect_depths_like_brute_force(scene, {{-70, 35, 80}, {0, 5, 0}, {0, 1, 0}, 50}, 96);
  }
}

// Trees are instances whose leaves lie among those of the houses. The ground around them has a
// hierarchy of its own: rays from within and from outside, level, from above and from below its rim.
TEST(Traversal, DepthsOfTreesAmongHousesAndOfTheHorizonMatchBruteForce) {
  for (const float angle : {0.0f, 33.0f}) {
    const scene::RenderScene scene = town_with_surroundings(angle).with({});
    EXPECT_EQ(scene.boxes_along == glm::vec2(1, 0), angle == 0);
    for (const auto& [from, to] : {std::pair(glm::vec3(-70, 35, 80), glm::vec3(0, 5, 0)),
                                   {{2, 1.7f, 1}, {60, 3, 20}},
                                   {{0, 60, 0}, {1, 0, 1}},
                                   {{-300, 2, 20}, {0, 3, 0}},
                                   {{55, 3, 55}, {400, 5, 300}},
                                   {{900, 4, 0}, {0, 4, 0}},
                                   {{0, 3000, 100}, {0, 0, 0}}})
      expect_depths_like_brute_force(scene, {turned(from, angle), turned(to, angle), {0, 1, 0}, 60},
                                     64);
  }
}

// Lamps that shine alike in all directions: the picture of a town does not change when all of it is
// turned, and the camera with it. Shadow rays go through boxes along the walls then.
TEST(Traversal, ATownIsLitTheSameAtAnyAngle) {
  const auto picture = [](float angle, bool boxes_are_turned) {
    std::vector<Light> lamps = random_lamps(30, 60, 4);
    for (Light& light : lamps) light.position = turned(light.position, angle);
    scene::RenderScene scene = turned(random_town(60, 60, 7), angle).with(lamps);
    if (!boxes_are_turned) scene.boxes_along = {1, 0};
    const scene::CameraPose pose{
        turned({-70, 35, 80}, angle), turned({0, 5, 0}, angle), {0, 1, 0}, 50};
    return render(scene, pose, with_estimator(render::Estimator::reference, 1), 48, 48, 1);
  };
  const measure::Image truth = picture(0, true);
  EXPECT_LT(measure::compare(picture(33, true), truth).rmse8, 1);
  if (test_device().trace() == gpu::Trace::compute) {  // which alone goes through our boxes
    EXPECT_GT(measure::compare(picture(33, false), truth).rmse8, 10) << "nodes that are misread";
  }
}

TEST(Traversal, HoldsFarFromTheOrigin) {
  SceneBuilder builder;
  builder.quad({7990, 0, 7990}, {7990, 0, 8010}, {8010, 0, 8010}, {8010, 0, 7990});
  builder.box({7998, 0, 7998}, {8002, 6, 8001});
  expect_depths_like_brute_force(builder.with({}),
                                 {{7985, 12, 8015}, {8000, 2, 8000}, {0, 1, 0}, 50}, 64);
}

// Rays are turned with errors that grow with the coordinates, for which turned boxes have a margin.
TEST(Traversal, HoldsFarFromTheOriginInATownAtAnAngle) {
  SceneBuilder builder = turned(random_town(60, 60, 7), 33);
  const glm::vec3 far(15'000, 0, -9000);
  for (glm::vec3& p : builder.scene().meshes[0].primitives[0].positions) p += far;
  const scene::RenderScene scene = builder.with({});
  EXPECT_NE(scene.boxes_along, glm::vec2(1, 0));
  expect_depths_like_brute_force(
      scene, {far + glm::vec3(-70, 35, 80), far + glm::vec3(0, 5, 0), {0, 1, 0}, 50}, 96);
}

TEST(Traversal, RaysAlongAnAxisHitWhatTheyShould) {
  // The camera looks exactly down -Z; the middle row and column have zero components.
  const scene::RenderScene scene = random_town(30, 40, 3).with({});
  expect_depths_like_brute_force(scene, {{0, 3, 60}, {0, 3, 0}, {0, 1, 0}, 60}, 65);
}

TEST(Traversal, InstancesStandWhereTheirMatricesSay) {
  SceneBuilder builder;
  builder.ground(50);
  Scene& scene = builder.scene();
  SceneBuilder post;
  post.box({-0.5f, 0, -0.5f}, {0.5f, 4, 0.5f});
  scene.meshes.push_back(post.scene().meshes[0]);
  SceneNode node{"lamps", "lamp", 1, true, {}};
  for (int i = 0; i < 40; ++i) {
    glm::mat4 m =
        glm::translate(glm::mat4(1.0f), glm::vec3(float(i % 8) * 5 - 18, 0, float(i / 8) * 6 - 15));
    m = glm::rotate(m, float(i), glm::vec3(0, 1, 0));
    m = glm::scale(m, glm::vec3(1.0f, 0.5f + 0.05f * float(i), 1.0f));
    node.instances.push_back({m, no_id});
  }
  scene.nodes.push_back(node);
  expect_depths_like_brute_force(builder.with({}), {{-25, 20, 40}, {0, 0, 0}, {0, 1, 0}, 50}, 80);
}

TEST(Traversal, InstancesAreTheSameInWhateverUnitTheirMeshIs) {
  const auto posts_in_units_of = [](float unit) {
    SceneBuilder builder, post;
    builder.ground(50);
    post.box(glm::vec3(-0.5f, 0, -0.5f) / unit, glm::vec3(0.5f, 4, 0.5f) / unit);
    builder.scene().meshes.push_back(post.scene().meshes[0]);
    SceneNode node{"lamps", "lamp", 1, true, {}};
    for (int i = 0; i < 8; ++i) {
      SceneInstance& instance = node.instances.emplace_back();
      for (int axis = 0; axis < 3; ++axis) instance.to_model[axis][axis] = unit;
      instance.to_model[3] = {float(i) * 5 - 18, 0, 0, 1};
    }
    builder.scene().nodes.push_back(node);
    return builder.with({});
  };
  const scene::RenderScene metres = posts_in_units_of(1);
  for (const float unit : {1e-15f, 1e-9f, 1e-6f, 1e-3f, 1e3f, 1e6f, 1e9f, 1e15f}) {
    SCOPED_TRACE(unit);
    const scene::RenderScene scene = posts_in_units_of(unit);
    EXPECT_TRUE(scene::describe_left_out(scene).empty());
    expect_depths_like(metres, scene, {{-20, 8, 20}, {0, 1, 0}, {0, 1, 0}, 60}, 64);
  }
}

TEST(Traversal, WhatCastsNoShadowIsSeenAndLetsLightThrough) {
  SceneBuilder builder(0.5f);
  builder.ground(50);
  Scene& scene = builder.scene();
  SceneBuilder plate;
  plate.quad({-4, 4, -4}, {-4, 4, 4}, {4, 4, 4}, {4, 4, -4});
  scene.meshes.push_back(plate.scene().meshes[0]);
  scene.nodes.push_back({"glass", "lamp", 1, false, {SceneInstance{}}});
  const std::vector<Light> lights{lamp({0, 8, 0}, 5000)};
  const scene::CameraPose below{{0, 2, 0}, {0, 0, 0}, {0, 0, -1}, 60};
  EXPECT_GT(mean_luminance(render(builder.with(lights), below, plain(), 8, 8, 1)), 0.5);
  const scene::CameraPose above{{0, 20, 0}, {0, 0, 0}, {0, 0, -1}, 10};
  EXPECT_NEAR(render(builder.with(lights), above, plain(), 8, 8, 1).layer("depth")->values[27],
              16.0, 0.1);
  scene.nodes.back().casts_shadow = true;
  EXPECT_EQ(mean_luminance(render(builder.with(lights), below, plain(), 8, 8, 1)), 0.0);
}

TEST(Traversal, AnEmptySceneIsDarkAndNoError) {
  const scene::RenderScene scene = scene::make_render_scene(Scene{}, {});
  EXPECT_EQ(mean_luminance(render(scene, {{0, 5, 0}, {0, 0, 1}, {0, 1, 0}, 50}, plain(), 8, 8, 1)),
            0.0);
}

}  // namespace
}  // namespace nightcity::test
