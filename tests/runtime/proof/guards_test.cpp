// Each numerical hazard has a property that holds, and that fails once its guard is removed from
// the shaders. docs/accuracy.md has the table.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "support/estimators.h"
#include "support/gpu.h"
#include "support/mutated_shaders.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using std::numbers::pi;

// Few candidates and a small radius, so that each guard matters.
render::RenderSettings settings_for(render::Estimator estimator) {
  return with_estimator(estimator, 8, 6);
}

struct Shot {
  scene::RenderScene scene;
  scene::CameraPose pose = looking_down;
  render::RenderSettings settings;
  std::uint32_t side = 16, frames = 1;
};

measure::Image taken(render::PassLibrary& passes, const Shot& shot) {
  render::DeviceScene device_scene(test_device(), shot.scene);
  render::Renderer renderer(test_device(), passes, device_scene, shot.side, shot.side);
  for (std::uint32_t i = 0; i < shot.frames; ++i) renderer.render_frame(shot.pose, shot.settings);
  return renderer.download();
}

using Property = std::function<bool(render::PassLibrary&)>;

// `poison` makes the hazard occur. With it, the property must hold, and must fail once the guard is
// removed.
void expect_guarded(const Property& holds, std::vector<ShaderEdit> guard,
                    const std::vector<ShaderEdit>& poison = {}) {
  if (poison.empty()) {
    EXPECT_TRUE(holds(test_passes())) << "with the guard";
  } else {
    const MutatedShaders poisoned(poison);
    render::PassLibrary passes(test_device());
    EXPECT_TRUE(holds(passes)) << "with the hazard and the guard";
  }
  guard.insert(guard.end(), poison.begin(), poison.end());
  const MutatedShaders without(guard);
  render::PassLibrary passes(test_device());
  EXPECT_FALSE(holds(passes)) << "without the guard nothing fails: the test does not bite";
}

// E = I cos / d^2 of `flux` lumen at (0, 8, 0) over a plane of reflectance 1/2: every pixel within
// 1 %.
bool obeys_the_inverse_square_law(const measure::Image& image, double flux) {
  const auto& points = image.layer("position")->values;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const double x = double(points[3 * i]), z = double(points[3 * i + 2]), d2 = x * x + z * z + 64;
    const double expected = 0.5 / pi * flux / (4 * pi) * 8 / std::sqrt(d2) / d2;
    if (!(std::abs(luminance(image, i) - expected) <= 0.01 * expected)) return false;
  }
  return true;
}

Shot one_lamp(render::Estimator estimator, float flux = 5000, std::uint32_t frames = 2) {
  return {SceneBuilder().ground(100).with({lamp({0, 8, 0}, flux)}), looking_down,
          settings_for(estimator), 16, frames};
}

Property lamp_law(render::Estimator estimator, float flux = 5000, std::uint32_t frames = 2) {
  return [=](render::PassLibrary& passes) {
    return obeys_the_inverse_square_law(taken(passes, one_lamp(estimator, flux, frames)),
                                        double(flux));
  };
}

const ShaderEdit finalize_guard{
    "reservoir.glsl",
    "builder.target > 0.0 ? normalisation * builder.weight_sum / builder.target : 0.0",
    "normalisation * builder.weight_sum / builder.target"};

// A target of zero gives no sample. A clamped divisor instead would darken all light that is
// fainter than the clamp.
TEST(Guard, FaintLightIsNotClampedAway) {
  expect_guarded(lamp_law(render::Estimator::pairwise, 1e-5f),
                 {{finalize_guard.file, finalize_guard.guard,
                   "normalisation * builder.weight_sum / max(builder.target, 1.0e-8)"}});
}

// Russian roulette drops half of the samples; those that stay stand for them. Without reuse, frames
// are independent, and the bound is six standard errors.
TEST(Guard, WhatRouletteKeepsIsWeighed) {
  Shot shot = one_lamp(render::Estimator::traced, 5000, 64);
  shot.settings.sampling.roulette_steps = 150;
  shot.settings.reuse.neighbours = 0;
  shot.settings.reuse.max_history = 0;
  Shot exact = one_lamp(render::Estimator::reference);
  const Property keeps_the_mean = [=](render::PassLibrary& passes) {
    const measure::Image ours = taken(passes, shot), truth = taken(passes, exact);
    double sum = 0, expected = 0;
    for (std::size_t i = 0; i < ours.pixels(); ++i) {
      sum += luminance(ours, i);
      expected += luminance(truth, i);
    }
    return std::abs(sum - expected) < 0.05 * expected;
  };
  expect_guarded(keeps_the_mean, {{"roulette.glsl", "? 1.0 / chance : 0.0", "? 1.0 : 0.0"}});
}

// A window lights one side only: on the other every target is zero, W would be 0 / 0.
TEST(Guard, WhereNoLightReachesThePictureIsBlackAndNotNaN) {
  const Property dark_half_is_dark = [](render::PassLibrary& passes) {
    const measure::Image image =
        taken(passes, {SceneBuilder().ground(100).with({window({0, 4, 0}, {0, 0, 1}, 1, 1, 500)}),
                       looking_down, settings_for(render::Estimator::ris), 16, 2});
    const auto& points = image.layer("position")->values;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      if (!std::isfinite(luminance(image, i))) return false;
      if (double(points[3 * i + 2]) < 0 && luminance(image, i) != 0) return false;
    }
    return true;
  };
  expect_guarded(dark_half_is_dark,
                 {finalize_guard,
                  {"reservoir.glsl", "r.W = finite(W) ? W : 0.0;", "r.W = W;"},
                  {"shade.comp", "reservoir.W > 0.0 && reservoir.light < SCENE.light_count",
                   "reservoir.M > 0.0"},
                  {"accumulate.comp", "if (!all_finite(radiance))", "if (false)"}});
}

const ShaderEdit poisoned_history{
    "temporal.comp",
    "FRAME.reservoirs.at[index] = finalize_with_roulette(reuse.builder, normalisation(reuse, "
    "balance));",
    "FRAME.reservoirs.at[index] = finalize_with_roulette(reuse.builder, normalisation(reuse, "
    "balance));\n"
    "  if (FRAME.frame == 2u) FRAME.reservoirs.at[index].W = uintBitsToFloat(0x7FC00000u);"};

// A reservoir with NaN or infinity is emptied when it is loaded; otherwise the history never
// recovers. No later test of W > 0 catches an infinite M.
TEST(Guard, AHistoryThatIsNoNumberIsForgotten) {
  Shot shot = one_lamp(render::Estimator::pairwise, 5000, 4);
  shot.settings.reuse.neighbours = 0;
  shot.settings.averaging.accumulate = false;
  expect_guarded(
      [&](render::PassLibrary& passes) {
        return obeys_the_inverse_square_law(taken(passes, shot), 5000);
      },
      {{"reservoir.glsl", "if (!sound) return EMPTY_RESERVOIR;", ""}}, {poisoned_history});
}

// No value that is not finite may stay in the sum, wherever it comes from.
TEST(Guard, OneFrameThatIsNoNumberDoesNotStayInThePicture) {
  const Property finite_mean = [](render::PassLibrary& passes) {
    const measure::Image image = taken(passes, one_lamp(render::Estimator::ris, 5000, 4));
    for (const float value : image.rgb)
      if (!std::isfinite(value) || value == 0) return false;
    return true;
  };
  expect_guarded(finite_mean, {{"accumulate.comp", "if (!all_finite(radiance))", "if (false)"}},
                 {{"shade.comp", "FRAME.radiance.at[index] = single_frame(",
                   "if (FRAME.frame == 1u) radiance += uintBitsToFloat(0x7FC00000u);\n  "
                   "FRAME.radiance.at[index] = single_frame("}});
}

// 80,000 lamps sampled uniformly: W is 80,000, and half floats end at 65,504.
TEST(Guard, WeightsBeyondHalfFloatsAreKept) {
  std::vector<Light> lights(80000, lamp({0, 8, 0}, 0.0625f));
  Shot shot{SceneBuilder().ground(100).with(lights), looking_down,
            settings_for(render::Estimator::pairwise), 8, 2};
  shot.settings.sampling.near_share = shot.settings.sampling.far_share = 0;
  shot.settings.sampling.uniform_share = 1;
  expect_guarded(
      [&](render::PassLibrary& passes) {
        return obeys_the_inverse_square_law(taken(passes, shot), 5000);
      },
      {{"reservoir.glsl", "r.W = finite(W) ? W : 0.0;",
        "r.W = unpackHalf2x16(packHalf2x16(vec2(W, 0.0))).x;"}});
}

// Lamps differ in colour and only temporal reuse is on. Returns how many pixels show another lamp
// 12 frames later.
TEST(Guard, HistoryFadesThroughTheCapOnM) {
  std::vector<Light> lights = random_lamps(60, 20, 4);
  for (std::size_t i = 0; i < lights.size(); ++i)
    lights[i].colour_rgb9e5 = encode_rgb9e5({1, 0.1f + 0.015f * float(i), 0});
  Shot shot{SceneBuilder().ground(100).with(lights), looking_down,
            settings_for(render::Estimator::pairwise)};
  shot.settings.reuse.neighbours = 0;
  shot.settings.reuse.max_history = 4;
  shot.settings.averaging.accumulate = false;
  const Property lamps_change = [&](render::PassLibrary& passes) {
    render::DeviceScene device_scene(test_device(), shot.scene);
    render::Renderer renderer(test_device(), passes, device_scene, shot.side, shot.side);
    const auto after = [&](int frames) {
      for (int i = 0; i < frames; ++i) renderer.render_frame(shot.pose, shot.settings);
      return renderer.download(false);
    };
    const measure::Image a = after(150), b = after(12);
    std::size_t same = 0;
    for (std::size_t i = 0; i < 3 * a.pixels(); i += 3)
      same += std::abs(a.rgb[i] * b.rgb[i + 1] - b.rgb[i] * a.rgb[i + 1]) <=
              1e-4f * a.rgb[i] * b.rgb[i + 1];
    return same < a.pixels() / 2;
  };
  expect_guarded(lamps_change,
                 {{"temporal.comp",
                   "history.M = min(history.M, longest_history(surface) * canonical.M);", ""}});
}

// One lamp over a checkerboard of steps: a neighbour on another step is not similar and must not
// dilute the weights.
TEST(Guard, NeighboursThatCannotContributeDoNotCount) {
  SceneBuilder steps;
  for (int x = -6; x < 6; ++x)
    for (int z = -6; z < 6; ++z)
      steps.ground(0).box({float(x) * 2, -1, float(z) * 2},
                          {float(x) * 2 + 2, (x + z) % 2 ? 0.0f : -0.9f, float(z) * 2 + 2});
  const std::vector<Light> lights{lamp({0, 200, 0}, 5e6f)};
  Shot shot{steps.with(lights), looking_down, settings_for(render::Estimator::pairwise), 32, 1};
  const measure::Image truth = [&] {
    Shot reference = shot;
    reference.settings.sampling.estimator = render::Estimator::reference;
    return taken(test_passes(), reference);
  }();
  expect_guarded(
      [&](render::PassLibrary& passes) {
        return std::abs(mean_luminance(taken(passes, shot)) / mean_luminance(truth) - 1) < 0.01;
      },
      {{"pair_reuse.comp", "if (partner == NO_HIT) continue;",
        "if (partner == NO_HIT) {\n"
        "      others_M += canonical.M;\n      continue;\n    }"}});
}

TEST(Guard, TargetsAreEvaluatedAtTheReceiver) {
  expect_guarded(
      lamp_law(render::Estimator::pairwise, 5000, 4),
      {{"pair_targets.comp", "reflected_sample(receiver, sampled.light, sampled.uv, shadowed)",
        "reflected_sample(receiver_of(FRAME.surfaces.at["
        "is_own ? index : FRAME.pair_partners.at[pair_place(turn - 1u, index)]]), "
        "sampled.light, sampled.uv, shadowed)"}});
}

// The camera moves from behind a wall to its front: a surface that was hidden has no history, and
// must not take the wall's.
TEST(Guard, WhatWasHiddenHasNoHistory) {
  SceneBuilder builder;
  builder.ground(100).box({-8, 0, 4}, {8, 10, 5});
  const scene::RenderScene scene = builder.with({lamp({0, 8, 0}, 5000)});
  render::RenderSettings settings = settings_for(render::Estimator::paper);
  settings.reuse.neighbours = 0;
  settings.averaging.accumulate = false;
  const scene::CameraPose before{{-6, 14, 30}, {0, 0, 0}, {0, 1, 0}, 50},
      after{{6, 22, 26}, {0, 0, 0}, {0, 1, 0}, 50};
  const Property no_smear = [&](render::PassLibrary& passes) {
    render::DeviceScene device_scene(test_device(), scene);
    render::Renderer moved(test_device(), passes, device_scene, 48, 48),
        fresh(test_device(), passes, device_scene, 48, 48);
    for (int i = 0; i < 8; ++i) moved.render_frame(before, settings);
    moved.render_frame(after, settings);
    fresh.render_frame(after, settings);
    const measure::Image a = moved.download(false), b = fresh.download(false);
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i)
      different += std::abs(luminance(a, i) - luminance(b, i)) > 0.02 * luminance(b, i) + 1e-6;
    return different < a.pixels() / 200;
  };
  expect_guarded(no_smear,
                 {{"history.glsl", "return similar(expected, FRAME.previous_surfaces.at[index]);",
                   "return FRAME.previous_surfaces.at[index].depth > 0.0;"}});
}

// A sample with an index beyond the lights is dropped. Without the guards the shader would read
// beyond the buffer, which no test should do, so only the guarded shader runs.
TEST(Guard, ALightIndexOutOfRangeIsDropped) {
  const MutatedShaders poisoned(
      {{"temporal.comp",
        "FRAME.reservoirs.at[index] = finalize_with_roulette(reuse.builder, normalisation(reuse, "
        "balance));",
        "FRAME.reservoirs.at[index] = finalize_with_roulette(reuse.builder, normalisation(reuse, "
        "balance));\n"
        "  if (FRAME.frame % 2u == 0u) FRAME.reservoirs.at[index].light = 0x7FFFFFF0u;"}});
  render::PassLibrary passes(test_device());
  Shot shot = one_lamp(render::Estimator::pairwise, 5000, 5);
  shot.settings.averaging.accumulate = false;
  for (std::uint32_t frames : {3u, 4u}) {
    shot.frames = frames;
    for (const float value : taken(passes, shot).rgb) ASSERT_TRUE(std::isfinite(value));
  }
}

// The greatest word of a random generator, times 2^-32, rounds to 1.0, and then no candidate is
// ever kept.
TEST(Guard, RandomNumbersStayBelowOne) {
  expect_guarded(lamp_law(render::Estimator::ris),
                 {{"random.glsl", "float(random_uint() >> 8u) * (1.0 / 16777216.0)",
                   "float(random_uint()) * (1.0 / 4294967296.0)"}},
                 {{"random.glsl", "return (word >> 22u) ^ word;", "return 0xFFFFFFFFu | word;"}});
}

// Nothing within a millimetre of a point lamp is lit by it, where d^2 tends to zero; just outside,
// that distance bounds the light on the ground.
TEST(Guard, AtTheLampItselfLightIsBounded) {
  // Points of the lamp below the ground would be in its shadow, so the ground casts none.
  const auto over_ground = [](float height) {
    SceneBuilder builder;
    builder.ground(100).scene().nodes[0].casts_shadow = false;
    return Shot{builder.with({lamp({0, height, 0}, 5000, 0)}), looking_down,
                settings_for(render::Estimator::reference), 1, 8};
  };
  const Shot within = over_ground(5e-4f), at_centre = over_ground(1e-20f),
             beyond = over_ground(1.1e-3f);
  const Property bounded = [&](render::PassLibrary& passes) {
    const double most = 0.5 / pi * 5000 / (4 * pi) * 2e6,
                 seen = luminance(taken(passes, beyond), 0);
    return luminance(taken(passes, within), 0) == 0 &&
           luminance(taken(passes, at_centre), 0) == 0 && seen > 0 && seen < most;
  };
  expect_guarded(bounded, {{"light_kinds.glsl", "if (d2 <= nearest * nearest) return s;", ""}});
}

TEST(Guard, AWindowWithoutAreaShinesAsASmallOne) {
  Light light = window({0, 8, 0}, {0, 0, 1}, 0, 0, 5000);
  light.axis = {0, -1, 0};
  light.tangent = {1, 0, 0};
  const Shot shot{SceneBuilder().ground(100).with({light}), looking_down,
                  settings_for(render::Estimator::pairwise), 16, 2};
  const Property as_a_point = [&](render::PassLibrary& passes) {
    const measure::Image image = taken(passes, shot);
    const auto& points = image.layer("position")->values;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const double x = double(points[3 * i]), z = double(points[3 * i + 2]),
                   d2 = x * x + z * z + 64;
      const double expected = 0.5 / pi * 5000 / pi * 64 / d2 / d2;
      if (!(std::abs(luminance(image, i) - expected) < 0.01 * expected)) return false;
    }
    return true;
  };
  expect_guarded(
      as_a_point,
      {{"light_kinds.glsl", "(light.flux_lm * cos_light / (PI * d2))",
        "(light.flux_lm / (PI * 4.0 * light.radius * light.half_height) * cos_light * 4.0 * "
        "light.radius * light.half_height / d2)"}});
}

// Rays exactly along an axis and in a face of a box compute 0 * infinity. The boxes are larger than
// their contents (bvh_test.cpp), so nothing is missed however a driver's min and max treat NaN.
TEST(Guard, RaysInThePlaneOfABoxHit) {
  SceneBuilder builder;
  for (int i = -8; i < 8; ++i)
    builder.quad({float(i), -8, 0}, {float(i) + 1, -8, 0}, {float(i) + 1, 8, 0}, {float(i), 8, 0});
  const scene::RenderScene scene = builder.with({});
  render::DeviceScene device_scene(test_device(), scene);
  render::Renderer renderer(test_device(), test_passes(), device_scene, 1, 1);
  for (int i = -7; i < 8; ++i)
    for (const float x :
         {float(i), std::nextafter(float(i), -99.0f), std::nextafter(float(i), 99.0f)}) {
      renderer.render_frame({{x, 0.5f, 10}, {x, 0.5f, 0}, {0, 1, 0}, 1},
                            settings_for(render::Estimator::ris));
      EXPECT_NEAR(renderer.download().layer("depth")->values[0], 10.0f, 1e-4f) << x;
    }
}

// A slanting wall 8 km from the origin, where floats are half a millimetre apart, lit at a grazing
// angle: an offset that clears a surface near the origin leaves the ray's start behind the wall
// here.
TEST(Guard, FarFromTheOriginASurfaceDoesNotShadowItself) {
  const glm::vec3 middle(8000.3f, 0, 8000.7f), along(20, 0, 13), up(0, 20, 0),
      out(-0.545f, 0, 0.8384f);
  SceneBuilder builder;
  builder.quad(middle - along - up, middle + along - up, middle + along + up, middle - along + up);
  const Shot shot{builder.with({lamp(middle + 0.1f * out, 5000, 0)}),
                  {middle + 20.0f * out, middle, {0, 1, 0}, 60},
                  settings_for(render::Estimator::reference),
                  32,
                  1};
  const Property all_lit = [&](render::PassLibrary& passes) {
    const measure::Image image = taken(passes, shot);
    for (std::size_t i = 0; i < image.pixels(); ++i)
      if (!(luminance(image, i) > 0)) return false;
    return true;
  };
  expect_guarded(
      all_lit,
      {{"geometry.glsl", "1.0e-6 * max(max(abs(p.x), abs(p.y)), max(abs(p.z), 1.0))", "1.0e-6"}});
}

// On a triangle of many kilometres, the distance along a ray is off by centimetres, so a shadow ray
// may hit the ground that it starts from.
TEST(Guard, AVastGroundDoesNotShadowItself) {
  const Shot shot{SceneBuilder().ground(500'000).with({lamp({0, 8, 0}, 5000)}),
                  {{0, 20, 0}, {0, 0, 0}, {0, 0, -1}, 90},
                  settings_for(render::Estimator::reference),
                  32,
                  1};
  const Property lit = [&](render::PassLibrary& passes) {
    return obeys_the_inverse_square_law(taken(passes, shot), 5000);
  };
  expect_guarded(lit, {{"geometry.glsl", " + 1.0e-6 * extent", ""}});
}

// A red and a blue lamp in one place and one candidate: in frame 0 of seed 0, each lamp must be
// taken by half the pixels.
TEST(Guard, TheFirstFrameOfSeedZeroIsRandom) {
  std::vector<Light> lights{lamp({0, 8, 0}, 5000), lamp({0, 8, 0}, 5000)};
  lights[0].colour_rgb9e5 = encode_rgb9e5({1, 0, 0});
  lights[1].colour_rgb9e5 = encode_rgb9e5({0, 0, 1});
  Shot shot{SceneBuilder().ground(100).with(lights), looking_down,
            settings_for(render::Estimator::ris), 32, 1};
  shot.settings.sampling.candidates = 1;
  const Property half_is_red = [&](render::PassLibrary& passes) {
    const measure::Image image = taken(passes, shot);
    double red = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) red += image.rgb[3 * i] > 0;
    return std::abs(red / double(image.pixels()) - 0.5) < 0.08;  // 5 standard deviations
  };
  expect_guarded(half_is_red,
                 {{"random.glsl", "pcg4d(uvec4(pixel, FRAME.frame, FRAME.seed * 16u + stream)).w",
                   "(pixel.x + pixel.y) * FRAME.frame * (FRAME.seed + stream)"}});
}

}  // namespace
}  // namespace nightcity::test
