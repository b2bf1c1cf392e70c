// Vehicles on the device against static copies of them, placed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "formats/error.h"
#include "runtime/render/vehicle_passes.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

using test::lamp;
using test::render;
using test::SceneBuilder;

constexpr double noon_to_eight = 8 * 3600;

TripKnot knot(glm::vec3 position, float time_s, glm::vec3 velocity, double yaw_turns = 0,
              bool braking = false) {
  const auto yaw = static_cast<uint>(std::lround(yaw_turns * 65536)) & 0xFFFFu;
  return {position, time_s, velocity, yaw | (braking ? KNOT_BRAKING : 0u)};
}

// A vehicle of 4 x 1.6 x 2 m with a lamp 1 m in front of its nose and one behind it that shines
// while it brakes.
scene::Traffic one_kind() {
  scene::Traffic traffic;
  traffic.cycle.cycle_s = 100;
  for (float& share : traffic.cycle.density) share = 1;
  Light front = lamp({3, 1, 0}, 1000), rear = lamp({-3, 1, 0}, 500);
  front.schedule = VEHICLE_LIGHT_ALWAYS;
  front.id = uint(LightFamily::headlamp);
  rear.schedule = VEHICLE_LIGHT_BRAKING;
  rear.id = uint(LightFamily::tail_lamp);
  traffic.vehicle_lights = {front, rear};
  traffic.vehicles = {{{2, 0.8f, 1}, 0, 2, {}}};
  return traffic;
}

void add_trip(scene::Traffic& traffic, const std::vector<TripKnot>& knots, float start_s = 0,
              float rank = 0) {
  const auto first = static_cast<uint>(traffic.knots.size()),
             id = static_cast<uint>(traffic.trips.size());
  traffic.knots.insert(traffic.knots.end(), knots.begin(), knots.end());
  traffic.trips.push_back({first, static_cast<uint>(knots.size()), start_s, rank, 0, id, {}});
}

scene::RenderScene with_traffic(scene::Traffic traffic, std::vector<Light> lights = {}) {
  scene::SceneLights all;
  all.lights = test::to_large(lights);
  all.traffic = std::move(traffic);
  return scene::make_render_scene(SceneBuilder().ground(60).scene(), std::move(all));
}

// The expected scene: a box on the ground and the given lamps.
scene::RenderScene place_static(const glm::vec3& lower, const glm::vec3& upper,
                                std::vector<Light> lights) {
  scene::SceneLights all;
  all.lights = test::to_large(lights);
  return scene::make_render_scene(SceneBuilder().ground(60).box(lower, upper).scene(),
                                  std::move(all));
}

const scene::CameraPose above{{0, 25, 12}, {0, 0, 0}, {0, 1, 0}, 60};

RenderSettings reference_at(double time_s) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::reference;
  settings.time_s = time_s;
  settings.sampling.jitter = false;
  return settings;
}

double relative_difference(const measure::Image& a, const measure::Image& b) {
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    difference += std::abs(test::luminance(a, i) - test::luminance(b, i));
    sum += test::luminance(b, i);
  }
  return difference / sum;
}

TEST(Vehicles, AVehicleIsWhereItsKnotsSayWithItsLightsAndShadow) {
  scene::Traffic traffic = one_kind();
  // East at 1 m/s from x = -10; the materials are the ground's.
  add_trip(traffic, {knot({-10, 0, 0}, 0, {1, 0, 0}), knot({10, 0, 0}, 20, {1, 0, 0})}, 5);
  // 400 cycles of 100 s make up noon + 40,000 s; 9 s into the drive.
  const measure::Image moving =
      render(with_traffic(traffic), above, reference_at(40'000 + 5 + 9), 48, 48, 1);
  const measure::Image placed =
      render(place_static({-3, 0, -1}, {1, 1.6f, 1}, {lamp({2, 1, 0}, 1000)}), above,
             reference_at(0), 48, 48, 1);
  EXPECT_GT(test::mean_luminance(placed), 0.01);
  EXPECT_LT(relative_difference(moving, placed), 0.002);
}

// Boxes lie along the walls there, those of vehicles too.
TEST(Vehicles, AreWhereTheyShouldBeInATownAtAnAngle) {
  SceneBuilder town;
  town.ground(60);
  for (int i = 0; i < 16; ++i) {
    const float x = float(i % 8) * 12 - 46, z = i < 8 ? -34.0f : 24.0f;
    town.box({x, 0, z}, {x + 9, 6 + float(i), z + 8});
  }
  town = test::turned(town, 33);
  scene::Traffic traffic = one_kind();
  std::vector<Light> lamps;
  SceneBuilder with_cars = town;
  for (int i = 0; i < 12; ++i) {
    const float x = float(i % 4) * 9 - 13, z = float(i / 4) * 7 - 7;
    add_trip(traffic, {knot({x, 0, z}, 0, {0, 0, 0}), knot({x, 0, z}, 90, {0, 0, 0})});
    with_cars.box({x - 2, 0, z - 1}, {x + 2, 1.6f, z + 1});
    lamps.push_back(lamp({x + 3, 1, z}, 1000));
  }
  scene::SceneLights moving_lights, placed_lights;
  moving_lights.traffic = std::move(traffic);
  placed_lights.lights = test::to_large(lamps);
  const scene::RenderScene moving =
      scene::make_render_scene(town.scene(), std::move(moving_lights));
  EXPECT_NE(moving.boxes_along, glm::vec2(1, 0));
  const scene::RenderScene placed =
      scene::make_render_scene(with_cars.scene(), std::move(placed_lights));
  const scene::CameraPose over{{0, 40, 20}, {0, 0, 0}, {0, 1, 0}, 60};
  const measure::Image truth = render(placed, over, reference_at(0), 64, 64, 4),
                       seen = render(moving, over, reference_at(10), 64, 64, 4);
  EXPECT_GT(test::mean_luminance(truth), 0.01);
  EXPECT_NEAR(test::mean_luminance(seen) / test::mean_luminance(truth), 1, 0.003);
  int wrong = 0;
  const auto &depth = seen.layer("depth")->values, &expected = truth.layer("depth")->values;
  for (std::size_t i = 0; i < depth.size(); ++i) wrong += std::abs(depth[i] - expected[i]) > 0.01f;
  EXPECT_LE(wrong, 4) << "rays that graze an edge";
  // Picked by their hierarchy, whose boxes lie along the walls as well.
  RenderSettings picked = reference_at(10);
  picked.sampling.estimator = Estimator::ris;
  const double mean = test::mean_luminance(render(moving, over, picked, 64, 64, 200));
  EXPECT_NEAR(mean / test::mean_luminance(truth), 1, 0.01);
}

// They are sorted by the squares of a map of the scene, which would be one square if it went on to
// the horizon.
TEST(Vehicles, AreSortedTheSameWithTheGroundAroundTheScene) {
  const auto picture = [](bool horizon) {
    scene::Traffic traffic = one_kind();
    for (int i = 0; i < 60; ++i) {
      const float x = float(i * 37 % 60) * 1.9f - 56, z = float(i * 23 % 60) * 1.9f - 56;
      add_trip(traffic, {knot({x, 0, z}, 0, {0, 0, 0}), knot({x, 0, z}, 90, {0, 0, 0})});
    }
    SceneBuilder builder;
    builder.ground(60);
    if (horizon) test::add_horizon(builder.scene(), 60, 0, 200, 30'000);
    scene::SceneLights lights;
    lights.traffic = std::move(traffic);
    RenderSettings settings = reference_at(10);
    settings.sampling.estimator = Estimator::ris;
    settings.sampling.candidates = 4;
    return render(scene::make_render_scene(builder.scene(), std::move(lights)), above, settings, 48,
                  48, 1);
  };
  const measure::Image with = picture(true), without = picture(false);
  EXPECT_GT(test::mean_luminance(without), 0.01);
  EXPECT_EQ(relative_difference(with, without), 0);
}

TEST(Vehicles, HeadingTurnsTheShortWayAndRearLampShinesWhileBraking) {
  scene::Traffic traffic = one_kind();
  // The vehicle stands and turns from 10 degrees right of east to 10 degrees left of it, so at half
  // time it faces east.
  add_trip(traffic, {knot({0, 0, 0}, 0, {0, 0, 0}, -10.0 / 360, true),
                     knot({0, 0, 0}, 20, {0, 0, 0}, 10.0 / 360)});
  const measure::Image moving = render(with_traffic(traffic), above, reference_at(10), 48, 48, 1);
  const measure::Image placed = render(
      place_static({-2, 0, -1}, {2, 1.6f, 1}, {lamp({3, 1, 0}, 1000), lamp({-3, 1, 0}, 500)}),
      above, reference_at(0), 48, 48, 1);
  EXPECT_LT(relative_difference(moving, placed), 0.002);
}

// The lens of a vehicle's lamp glows so that it is seen. What it lights, the lamp lights.
TEST(Vehicles, LensesGlowForTheCameraOnly) {
  scene::Traffic traffic = one_kind();
  traffic.vehicle_lights.erase(traffic.vehicle_lights.begin());  // what is left shines on braking
  traffic.vehicles[0].light_count = 1;
  add_trip(traffic, {knot({0, 0, 0}, 0, {0, 0, 0}), knot({0, 0, 0}, 20, {0, 0, 0})});
  SceneBuilder builder;
  builder.ground(60);
  Scene& scene = builder.scene();
  scene.materials.push_back({"lens", glm::vec3(0.5f), glm::vec3(1000), 1.0f, true});
  scene.meshes.push_back(SceneBuilder().box({-2, 0, -1}, {2, 1.6f, 1}).scene().meshes[0]);
  scene.meshes[1].primitives[0].material = 1;
  scene.nodes.push_back({"body", "vehicle", 1, true, {}});
  scene.nodes.back().vehicle = 0;
  scene::SceneLights all;
  all.traffic = std::move(traffic);
  const scene::RenderScene with_body = scene::make_render_scene(scene, std::move(all));
  RenderSettings settings = reference_at(10);
  settings.indirect.bounces = 1;
  EXPECT_GT(test::mean_luminance(render(with_body, above, settings, 24, 24, 1)), 1);
  const scene::CameraPose beside{{6, 4, 6}, {5, 0, 5}, {0, 1, 0}, 30};
  for (const Estimator estimator : {Estimator::reference, Estimator::traced}) {
    settings.sampling.estimator = estimator;
    EXPECT_EQ(test::mean_luminance(render(with_body, beside, settings, 24, 24, 4)), 0);
  }
}

TEST(Vehicles, IsDarkBeforeADriveAfterItAndWhereTheHourHasNoTraffic) {
  scene::Traffic traffic = one_kind();
  add_trip(traffic, {knot({-10, 0, 0}, 0, {1, 0, 0}), knot({10, 0, 0}, 20, {1, 0, 0})}, 50, 0.5f);
  traffic.cycle.density[3] =
      0.4f;  // below the trip's rank from somewhere before 15:00 to somewhere after
  const auto mean = [&](double time_s) {
    return test::mean_luminance(
        render(with_traffic(traffic), above, reference_at(time_s), 16, 16, 1));
  };
  EXPECT_EQ(mean(noon_to_eight + 49), 0) << "28,800 s are 288 cycles";
  EXPECT_GT(mean(noon_to_eight + 51), 0);
  EXPECT_EQ(mean(noon_to_eight + 71), 0);
  EXPECT_GT(mean(noon_to_eight + 151), 0) << "the next cycle";
  EXPECT_EQ(mean(3 * 3600 + 51), 0) << "15:00";
}

// Enough vehicles for several levels of the BVH, all over the ground. Their lamps hang high, so
// that no few pixels near a lamp hold most of a picture's light.
scene::Traffic crowd(int count) {
  scene::Traffic traffic = one_kind();
  for (Light& light : traffic.vehicle_lights) light.position.y = 5;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-50, 50), turn(0, 1), speed(-3, 3);
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from(place(random), 0, place(random)),
        velocity(speed(random), 0, speed(random));
    const double yaw = double(turn(random));
    add_trip(traffic, {knot(from, 0, velocity, yaw, i % 3 == 0),
                       knot(from + 40.0f * velocity, 40, velocity, yaw)});
  }
  return traffic;
}

TEST(Vehicles, HaveACellEachAsFarAsCellsGo) {
  EXPECT_EQ(choose_vehicle_cells_per_side(1), 1u);
  EXPECT_EQ(choose_vehicle_cells_per_side(2), 2u);
  EXPECT_EQ(choose_vehicle_cells_per_side(4), 2u);
  EXPECT_EQ(choose_vehicle_cells_per_side(5), 4u);
  EXPECT_EQ(choose_vehicle_cells_per_side(4'000'000), MAX_VEHICLE_CELLS_PER_SIDE);
}

TEST(Vehicles, PickedLightsGiveTheReferenceWithoutBias) {
  const scene::RenderScene scene =
      with_traffic(crowd(90), {lamp({20, 8, 10}, 5000), lamp({-20, 8, -10}, 5000)});
  const scene::CameraPose pose{{0, 60, 40}, {0, 0, 0}, {0, 1, 0}, 60};
  const measure::Image truth = render(scene, pose, reference_at(17), 24, 24, 4);
  for (const Estimator estimator : {Estimator::ris, Estimator::pairwise}) {
    RenderSettings settings = reference_at(17);
    settings.sampling.estimator = estimator;
    // Frames of one run share samples, so the error of the mean is estimated from the means of
    // independent runs.
    constexpr unsigned runs = 10;
    double sum = 0, squares = 0;
    for (settings.sampling.seed = 1; settings.sampling.seed <= runs; ++settings.sampling.seed) {
      const double ratio = test::mean_luminance(render(scene, pose, settings, 24, 24, 6)) /
                           test::mean_luminance(truth);
      sum += ratio;
      squares += ratio * ratio;
    }
    const double mean = sum / runs, error = std::sqrt((squares / runs - mean * mean) / (runs - 1));
    EXPECT_LT(error, 0.02) << name_of(estimator);
    EXPECT_LT(std::abs(mean - 1), 5 * error) << name_of(estimator) << " " << mean;
    RecordProperty(name_of(estimator), std::to_string(mean) + " +- " + std::to_string(error));
  }
}

double mean_of_vehicles(const measure::Image& image) {
  double sum = 0;
  const std::vector<float>& values = image.layer("direct_vehicles")->values;
  for (const float value : values) sum += double{value};
  return sum / double(values.size());
}

// Lamps a thousand times as strong as the headlamps leave these few candidates.
TEST(Vehicles, KeepTheirLightWhereStaticLightsTakeTheCandidates) {
  const scene::RenderScene scene =
      with_traffic(crowd(90), {lamp({20, 8, 10}, 1e6f), lamp({-20, 8, -10}, 1e6f)});
  const scene::CameraPose pose{{0, 60, 40}, {0, 0, 0}, {0, 1, 0}, 60};
  RenderSettings settings = reference_at(17);
  settings.sampling.layers = true;
  const double truth = mean_of_vehicles(render(scene, pose, settings, 24, 24, 4));
  settings.sampling.estimator = Estimator::ris;
  constexpr unsigned runs = 10;
  double sum = 0, squares = 0;
  for (settings.sampling.seed = 1; settings.sampling.seed <= runs; ++settings.sampling.seed) {
    const double ratio = mean_of_vehicles(render(scene, pose, settings, 24, 24, 64)) / truth;
    sum += ratio;
    squares += ratio * ratio;
  }
  const double mean = sum / runs, error = std::sqrt((squares / runs - mean * mean) / (runs - 1));
  std::printf("  %.4f +- %.4f\n", mean, error);
  EXPECT_LT(error, 0.05);
  EXPECT_LT(std::abs(mean - 1), 5 * error);
}

TEST(Vehicles, HistoryOfMovingLightsBringsNoBias) {
  const scene::RenderScene scene = with_traffic(crowd(60));
  const scene::CameraPose pose{{0, 60, 40}, {0, 0, 0}, {0, 1, 0}, 60};
  gpu::Device& device = test::test_device();
  DeviceScene device_scene(device, scene);
  Renderer moving(device, test::test_passes(), device_scene, 20, 20);
  RenderSettings settings = reference_at(0);
  settings.sampling.estimator = Estimator::pairwise;
  // A large radius and a short history: frames share few samples, so a few frames suffice.
  settings.reuse.neighbour_radius_px = 30;
  settings.reuse.max_history = 4;
  double estimated = 0, truth = 0;
  std::vector<double> times;
  for (int i = 0; i < 48; ++i) {
    settings.time_s = 5 + 0.5 * i;  // up to 1.5 m a frame: lamps jump past each other's light
    moving.render_frame(pose, settings);
    if (i < 8) continue;
    EXPECT_EQ(moving.frames(), 1u) << "no mean over moments";
    estimated += test::mean_luminance(moving.download(false));
    times.push_back(settings.time_s);
  }
  Renderer still(device, test::test_passes(), device_scene, 20, 20);
  for (const double time : times) {
    still.render_frame(pose, reference_at(time));
    truth += test::mean_luminance(still.download(false));
  }
  EXPECT_NEAR(estimated / truth, 1, 0.02);
}

TEST(Vehicles, APictureDependsOnTheTimeOnlyNotOnTheFramesBefore) {
  const scene::RenderScene scene = with_traffic(crowd(60));
  gpu::Device& device = test::test_device();
  DeviceScene device_scene(device, scene);
  std::vector<float> pictures[2];
  for (const int steps : {1, 7}) {
    Renderer renderer(device, test::test_passes(), device_scene, 24, 24);
    for (int i = 1; i <= steps; ++i) renderer.render_frame(above, reference_at(21.0 * i / steps));
    pictures[steps == 7] = renderer.download(false).rgb;
  }
  // The reference's stratified points on a lamp differ from frame to frame; the lamp's place does
  // not.
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < pictures[0].size(); ++i) {
    difference += std::abs(double(pictures[0][i]) - double(pictures[1][i]));
    sum += double(pictures[0][i]);
  }
  EXPECT_LT(difference / sum, 0.01);
}

// Renderers of one scene have its vehicles at times of their own, this frame's and the one
// before's. The third renderer asks for more room than the scene has at first.
TEST(Vehicles, RenderersOfOneSceneDoNotDisturbEachOther) {
  const scene::RenderScene scene = with_traffic(crowd(60), {lamp({5, 8, 5}, 3000)});
  gpu::Device& device = test::test_device();
  RenderSettings settings = reference_at(0);
  settings.sampling.estimator = Estimator::traced;
  const auto render_moment = [&](Renderer& renderer, int index, int moment) {
    settings.time_s = 5.0 + 7 * index + 0.5 * moment;
    renderer.render_frame(above, settings);
  };
  constexpr int count = 3, moments = 3;
  std::vector<std::vector<float>> alone;
  for (int i = 0; i < count; ++i) {
    DeviceScene device_scene(device, scene);
    Renderer renderer(device, test::test_passes(), device_scene, 16, 16);
    for (int moment = 0; moment < moments; ++moment) render_moment(renderer, i, moment);
    alone.push_back(renderer.download(false).rgb);
  }
  DeviceScene shared(device, scene);
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (int i = 0; i < count; ++i)
    renderers.push_back(std::make_unique<Renderer>(device, test::test_passes(), shared, 16u, 16u));
  for (int moment = 0; moment < moments; ++moment)
    for (int i = 0; i < count; ++i) render_moment(*renderers[std::size_t(i)], i, moment);
  for (int i = 0; i < count; ++i)
    EXPECT_EQ(renderers[std::size_t(i)]->download(false).rgb, alone[std::size_t(i)]) << i;
}

// Without traffic and without the lights of vehicles, the street has the light of its lamp alone.
TEST(Vehicles, TrafficAndTheLightsOfVehiclesCanBeTakenAway) {
  const std::vector<Light> lamps{lamp({5, 8, 5}, 3000)};
  const scene::RenderScene scene = with_traffic(crowd(60), lamps),
                           empty = with_traffic(one_kind(), lamps);
  RenderSettings settings = reference_at(5);
  const auto mean = [&](const scene::RenderScene& of) {
    return test::mean_luminance(render(of, above, settings, 24, 24, 4));
  };
  const double all = mean(scene), street = mean(empty);
  settings.environment.traffic = 0;
  EXPECT_NEAR(mean(scene) / street, 1, 1e-6);
  settings.environment.traffic = 1;
  // Lights of no named family are `other`; those of this crowd have the id of a lamp.
  settings.environment.lights = scene::to_set(LightFamily::other);
  const double dark = mean(scene);  // bodies stand in the lamp's light
  EXPECT_GT(all, 1.05 * dark);
  EXPECT_NEAR(dark / street, 1, 0.3);
  settings.environment.lights = scene::all_families;
  EXPECT_NEAR(mean(scene) / all, 1, 1e-6);
}

TEST(Vehicles, AShareOfCandidatesThatLosesItsLightIsRefused) {
  RenderSettings settings;
  for (const float share : {0.0f, 1.0f}) {
    settings.sampling.vehicle_share = share;
    EXPECT_THROW(render(with_traffic(crowd(3)), above, settings, 4, 4, 1), UsageError);
  }
}

TEST(Vehicles, ABrokenTripIsRefused) {
  scene::Traffic traffic = one_kind();
  add_trip(traffic, {knot({0, 0, 0}, 0, {0, 0, 0}),
                     knot({0, 0, 0}, 200, {0, 0, 0})});  // longer than the cycle
  EXPECT_THROW(with_traffic(traffic), Error);
}

}  // namespace
}  // namespace nightcity::render
