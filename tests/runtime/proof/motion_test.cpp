// Compares every pixel of an estimator's picture with the reference's while things move. Each run
// renders the same few moments with another seed, and the picture of the last moment is judged. A
// history that is weighted by the wrong frame's lights, shadows or surfaces shows here, and in no
// scene that stands still.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <initializer_list>

#include "support/estimators.h"
#include "support/independent_runs.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

constexpr std::uint32_t side = 24;  // whole workgroups
constexpr int moments = 6;

struct Moving {
  scene::RenderScene scene;
  double first_s, step_s;  // the clock
  std::function<scene::CameraPose(int moment)> pose_at;
};

scene::CameraPose still_at_the_wall(int) {
  return {{4, 9, 12}, {0, 0.5f, -1}, {0, 1, 0}, 50};
}

measure::PictureStatistics last_moments(render::Renderer& renderer, const Moving& place,
                                        render::RenderSettings settings, std::uint32_t runs,
                                        std::uint32_t first_seed) {
  measure::PictureStatistics statistics;
  for (std::uint32_t run = 0; run < count_runs(runs); ++run) {
    settings.sampling.seed = first_seed + run;
    for (int moment = 0; moment < moments; ++moment) {
      settings.time_s = place.first_s + place.step_s * moment;
      renderer.render_frame(place.pose_at(moment), settings);
    }
    EXPECT_EQ(renderer.frames(), 1u) << "no mean over moments";
    statistics.add(renderer.download(false));
  }
  return statistics;
}

measure::PictureStatistics truth_of_last_moment(render::Renderer& renderer, const Moving& place) {
  render::RenderSettings settings = with_estimator(render::Estimator::reference);
  settings.time_s = place.first_s + place.step_s * (moments - 1);
  return independent_runs(renderer, place.pose_at(moments - 1), settings, 16, 4, 5000);
}

// The criterion of unbiased_test.cpp: at a joint level of 1 %, at most 0.25 % of the pixels differ.
void expect_unbiased(const measure::PictureStatistics& truth, render::Renderer& renderer,
                     const Moving& place, render::Estimator estimator, std::uint32_t runs) {
  render::RenderSettings settings = with_estimator(estimator, 16, 8);
  // The weights of `basic` vary most, and less with more partners.
  if (estimator == render::Estimator::basic) settings.reuse.neighbours = 4;
  const measure::PictureStatistics ours = last_moments(renderer, place, settings, runs, 1);
  const measure::PixelTest verdict = measure::test_pixels(ours, truth, 0.01, 1e-4);
  std::printf("  %-10s %6.2f %% of %zu pixels pass, mean %+.3f %% +- %.3f %%\n",
              render::name_of(estimator), 100 * verdict.passed_share(), verdict.pixels,
              100 * verdict.relative_mean, 100 * verdict.relative_mean_error);
  EXPECT_GE(verdict.passed_share(), 0.9975) << render::name_of(estimator);
  EXPECT_LT(std::abs(verdict.relative_mean), 4 * verdict.relative_mean_error)
      << render::name_of(estimator);
  EXPECT_LT(verdict.relative_mean_error, estimator == render::Estimator::basic ? 0.05 : 0.01)
      << render::name_of(estimator) << ": too noisy to tell";
}

void expect_unbiased(const Moving& place, std::initializer_list<render::Estimator> estimators,
                     std::uint32_t runs = 240) {
  render::DeviceScene device_scene(test_device(), place.scene);
  // Two renderers share the scene; neither may overwrite the other's previous frame.
  render::Renderer judge(test_device(), test_passes(), device_scene, side, side);
  render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
  const measure::PictureStatistics truth = truth_of_last_moment(judge, place);
  for (const render::Estimator estimator : estimators)
    expect_unbiased(truth, renderer, place, estimator, runs);
}

void expect_every_estimator_unbiased(const Moving& place) {
  expect_unbiased(place, {render::Estimator::ris, render::Estimator::basic,
                          render::Estimator::pairwise, render::Estimator::traced});
}

TripKnot knot(glm::vec3 position, float time_s, glm::vec3 velocity) {
  return {position, time_s, velocity, 0};
}

// A vehicle with a headlamp 10 cm in front of its nose, driving east at 12 m/s: a frame later, the
// body stands where the lamp was.
scene::Traffic one_vehicle(const glm::vec3& half_size, float lane_z) {
  scene::Traffic traffic;
  traffic.cycle.cycle_s = 100;
  for (float& share : traffic.cycle.density) share = 1;
  Light front = lamp({half_size.x + 0.15f, 0.7f, 0}, 3000, 0.05f);
  front.axis = {1, 0, 0};
  front.tangent = {0, 0, 1};
  front.schedule = VEHICLE_LIGHT_ALWAYS;
  front.id = uint(LightFamily::headlamp);
  traffic.vehicle_lights = {front};
  traffic.vehicles = {{half_size, 0, 1, {}}};
  traffic.knots = {knot({-12, 0, lane_z}, 0, {12, 0, 0}), knot({12, 0, lane_z}, 2, {12, 0, 0})};
  traffic.trips = {{0, 2, 0, 0, 0, 0, {}}};
  return traffic;
}

SceneBuilder wall_and_ground() {
  return SceneBuilder().ground(20).box({-6, 0, -4}, {6, 3, -3.5f}).box({1, 0, -2}, {2, 1.5f, -1});
}

Moving headlamp_passing_a_wall(double step_s) {
  scene::SceneLights lights;
  lights.lights = {lamp({-3, 5, 3}, 800, 0.1f), lamp({5, 4, -1}, 500, 0.1f)};
  lights.traffic = one_vehicle({2, 0.8f, 0.9f}, 0.5f);
  return {scene::make_render_scene(wall_and_ground().scene(), std::move(lights)),
          1 - step_s * (moments - 1), step_s, still_at_the_wall};
}

Moving van_between_lamp_and_ground(double step_s) {
  scene::SceneLights lights;
  lights.lights = {lamp({0, 6, -2.5f}, 4000, 0.1f), lamp({-5, 5, 3}, 1000, 0.1f)};
  lights.traffic = one_vehicle({3, 1.6f, 1.1f}, 0.5f);
  return {scene::make_render_scene(wall_and_ground().scene(), std::move(lights)),
          1 - step_s * (moments - 1), step_s, still_at_the_wall};
}

// Half a step before the last moment one car's trip ends and another's begins, elsewhere: with
// their lights they vanish and appear between two frames.
Moving cars_that_vanish_and_appear(double step_s) {
  scene::SceneLights lights;
  lights.lights = {lamp({-3, 5, 3}, 800, 0.1f), lamp({5, 4, -1}, 500, 0.1f)};
  lights.traffic = one_vehicle({2, 0.8f, 0.9f}, 0.5f);
  const float change_s = 1 - 0.5f * float(step_s);
  const glm::vec3 east(12, 0, 0);
  lights.traffic.knots = {knot({-12, 0, 0.5f}, 0, east),
                          knot({-12 + 12 * change_s, 0, 0.5f}, change_s, east),
                          knot({-4, 0, 3.5f}, 0, east), knot({8, 0, 3.5f}, 1, east)};
  lights.traffic.trips = {{0, 2, 0, 0, 0, 0, {}}, {2, 2, change_s, 0, 0, 1, {}}};
  return {scene::make_render_scene(wall_and_ground().scene(), std::move(lights)),
          1 - step_s * (moments - 1), step_s, still_at_the_wall};
}

// Windows in a wall that go on and off from moment to moment, and a lamp that stays on.
Moving windows_that_switch() {
  scene::SceneLights lights;
  lights.lights = {lamp({4, 5, 3}, 600, 0.1f)};
  lights.switches = {98, 101, 97, 99, 100};
  lights.schedules = {{0, 2}, {2, 2}, {4, 1}};  // on 98-101; on 97-99; on from 100
  for (int i = 0; i < 6; ++i) {
    Light pane = window({float(i) * 1.8f - 4.5f, 1.5f, -3.49f}, {0, 0, 1}, 0.6f, 0.8f, 300);
    pane.schedule = static_cast<uint>(i % 3);
    lights.lights.push_back(pane);
  }
  return {scene::make_render_scene(wall_and_ground().scene(), std::move(lights)), 95.0, 1.0,
          still_at_the_wall};
}

// The camera moves sideways and turns, half a metre per moment.
scene::CameraPose walking(int moment) {
  scene::CameraPose pose = still_at_the_wall(moment);
  const float way = 0.5f * float(moment - (moments - 1));
  pose.position += glm::vec3(way, 0.1f * way, 0.3f * way);
  pose.target += glm::vec3(0.3f * way, 0, 0);
  return pose;
}

TEST(UnbiasedInMotion, AHeadlampPassesAWall) {
  expect_every_estimator_unbiased(headlamp_passing_a_wall(1.0 / 30));
}
TEST(UnbiasedInMotion, AHeadlampPassesAWallFast) {
  expect_unbiased(headlamp_passing_a_wall(0.25), {render::Estimator::traced});
}
TEST(UnbiasedInMotion, AVanDrivesBetweenLampAndGround) {
  expect_every_estimator_unbiased(van_between_lamp_and_ground(1.0 / 30));
}
TEST(UnbiasedInMotion, CarsVanishAndAppear) {
  expect_unbiased(cars_that_vanish_and_appear(1.0 / 30),
                  {render::Estimator::pairwise, render::Estimator::traced});
}
TEST(UnbiasedInMotion, WindowsSwitch) {
  expect_every_estimator_unbiased(windows_that_switch());
}
TEST(UnbiasedInMotion, TheCameraMovesWithAllOfIt) {
  Moving place = van_between_lamp_and_ground(1.0 / 30);
  place.pose_at = walking;
  expect_every_estimator_unbiased(place);
}

}  // namespace
}  // namespace nightcity::test
