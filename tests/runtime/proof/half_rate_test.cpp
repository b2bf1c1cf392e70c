// Half rate: frames that sample every second pixel. What they sample is unbiased, at rest and in
// motion; what they fill is as good as the surfaces beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/estimators.h"
#include "support/lit_place.h"

namespace nightcity::test {
namespace {

constexpr std::uint32_t side = 16;

render::RenderSettings half_rate(render::Estimator estimator, std::uint32_t candidates = 16) {
  render::RenderSettings settings = with_estimator(estimator, candidates, 8);
  settings.sampling.half_rate = true;
  return settings;
}

// The renderer's n-th frame, from 0, samples these.
bool is_sampled(std::size_t x, std::size_t y, std::uint32_t frame) {
  return (x + y + 1 + frame % 2) % 2 == 0;
}

LitPlace lit_courtyard() {
  return courtyard({{-9, 14, 17}, {-1, 0, 3}, {0, 1, 0}, 35}, 0.2f);
}

// Under an even sky every point of a plane reflects the same share of it, whatever ray is drawn: in
// one frame, filled pixels are as exact as the others, beside stripes of other reflectances too.
TEST(HalfRate, AnEvenlyLitPlaneOfManyReflectancesIsExactInOneFrame) {
  SceneBuilder builder(0.5f);
  Scene& scene = builder.scene();
  scene.materials.push_back({"paint", {0.8f, 0.6f, 0.1f}, glm::vec3(0), 1.0f, true});
  ScenePrimitive strips;
  strips.material = 1;
  scene.meshes[0].primitives.push_back(strips);
  scene.nodes[0].instances.resize(1);
  const auto add_strip = [&](std::size_t material, float from, float to) {
    ScenePrimitive& p = scene.meshes[0].primitives[material];
    const auto base = static_cast<std::uint32_t>(p.positions.size());
    p.positions.insert(p.positions.end(),
                       {{from, 0, -50}, {from, 0, 50}, {to, 0, 50}, {to, 0, -50}});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(base + corner);
  };
  for (int i = -20; i < 20; ++i) {
    add_strip(0, float(i) * 2, float(i) * 2 + 1.3f);
    add_strip(1, float(i) * 2 + 1.3f, float(i) * 2 + 2);
  }
  render::RenderSettings settings = half_rate(render::Estimator::traced);
  settings.environment.sky_cd_m2 = glm::vec3(3);
  const measure::Image image =
      render(builder.with({}), {{1, 20, 3}, {0, 0, 0}, {0, 1, 0}, 50}, settings, 64, 48, 1);
  const auto& albedo = image.layer("albedo")->values;
  std::size_t paint = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    paint += albedo[3 * i] > 0.6f;
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(image.rgb[3 * i + c], 3 * albedo[3 * i + c], 1e-4 * albedo[3 * i + c])
          << "pixel " << i << " channel " << c;
  }
  EXPECT_GT(paint, 500u);
}

// A point lamp alone leaves no noise, so a filled pixel is told from its truth: it lies within what
// like surfaces beside it show, and a pixel without any shows its own light. The scene has edges of
// all kinds: depth, normal, shadow.
TEST(HalfRate, APixelIsFilledFromLikeSurfacesOnly) {
  const LitPlace place{
      boxes_on_a_plane(), {lamp({-6, 7, 0}, 6000, 0)}, {{-9, 14, 17}, {-1, 0, 0}, {0, 1, 0}, 50}};
  constexpr std::uint32_t width = 96, height = 72;
  const measure::Image truth =
                           render(place.scene(), place.pose,
                                  with_estimator(render::Estimator::reference), width, height, 1),
                       filled = render(place.scene(), place.pose,
                                       half_rate(render::Estimator::traced), width, height, 1);
  const auto& points = truth.layer("position")->values;
  const auto& normals = truth.layer("normal")->values;
  const auto vector_at = [](const std::vector<float>& values, std::size_t i) {
    return glm::dvec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  };
  std::size_t of_neighbours = 0, of_itself = 0, lit = 0;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      const double own = luminance(truth, i), shown = luminance(filled, i);
      lit += own > 0;
      double least = own, most = own;
      bool is_alone = true;
      const auto look_at = [&](std::size_t at) {
        const glm::dvec3 way = vector_at(points, at) - vector_at(points, i);
        if (glm::dot(vector_at(normals, at), vector_at(normals, i)) < 0.999 ||
            std::abs(glm::dot(way, vector_at(normals, i))) > 0.05)
          return;
        is_alone = false;
        least = std::min(least, luminance(truth, at));
        most = std::max(most, luminance(truth, at));
      };
      if (!is_sampled(x, y, 0)) {
        if (x > 0) look_at(i - 1);
        if (x + 1 < width) look_at(i + 1);
        if (y > 0) look_at(i - width);
        if (y + 1 < height) look_at(i + width);
        (is_alone ? of_itself : of_neighbours) += 1;
      }
      EXPECT_GE(shown, least * 0.999 - 1e-6) << x << ", " << y;
      EXPECT_LE(shown, most * 1.001 + 1e-6) << x << ", " << y;
    }
  EXPECT_GT(lit, truth.pixels() / 2);
  EXPECT_GT(of_neighbours, truth.pixels() / 3);
  EXPECT_GT(of_itself, 5u);
}

class HalfRateOf : public testing::TestWithParam<render::EstimatorTraits> {};

std::vector<render::EstimatorTraits> list_unbiased() {
  std::vector<render::EstimatorTraits> unbiased = render::list_estimators();
  std::erase_if(unbiased,
                [](const auto& traits) { return !traits.samples || traits.as_published; });
  return unbiased;
}

INSTANTIATE_TEST_SUITE_P(Estimators, HalfRateOf, testing::ValuesIn(list_unbiased()),
                         [](const auto& info) { return std::string(info.param.name); });

// Two frames sample all pixels, and what was filled before is gone from the mean.
TEST_P(HalfRateOf, AMeanAtRestIsUnbiased) {
  const LitPlace place = lit_courtyard();
  const measure::PictureStatistics truth =
      independent_runs(place, with_estimator(render::Estimator::reference), side, 16, 16, 5000);
  const bool noisy = GetParam().estimator == render::Estimator::basic;
  expect_equal(
      independent_runs(place, half_rate(GetParam().estimator), side, noisy ? 400 : 80, 8, 1),
      truth, 1e-4, 1);
}

// The pixels that a frame samples take their history from those that the frame before did.
TEST_P(HalfRateOf, WhatAFrameInMotionSamplesIsUnbiased) {
  const LitPlace place = lit_courtyard();
  const scene::RenderScene scene = place.scene();
  render::DeviceScene device_scene(test_device(), scene);
  render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
  render::RenderSettings settings = half_rate(GetParam().estimator);
  constexpr int moments = 4;
  const auto of_the_last_frame = [](measure::Image image) {
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = 0; x < side; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          if (!is_sampled(x, y, moments - 1)) image.rgb[3 * (y * side + x) + c] = 0;
    return image;
  };
  measure::PictureStatistics ours, truth;
  for (std::uint32_t run = 0; run < count_runs(400); ++run) {
    settings.sampling.seed = run + 1;
    for (int moment = 0; moment < moments; ++moment) {
      scene::CameraPose pose = place.pose;
      pose.position += float(moments - 1 - moment) * glm::vec3(0.5f, -0.2f, 0.3f);
      renderer.render_frame(pose, settings);
    }
    ours.add(of_the_last_frame(renderer.download(false)));
  }
  render::Renderer judge(test_device(), test_passes(), device_scene, side, side);
  render::RenderSettings exact = with_estimator(render::Estimator::reference);
  for (std::uint32_t run = 0; run < 16; ++run) {
    exact.sampling.seed = 5000 + run;
    for (int frame = 0; frame < 16; ++frame) judge.render_frame(place.pose, exact);
    truth.add(of_the_last_frame(judge.download(false)));
  }
  expect_equal(ours, truth, 1e-4, 1);
}

// A frame that stands alone has the error of what was filled.
TEST(HalfRate, AFrameThatStandsAloneIsNearlyRight) {
  const LitPlace place = lit_courtyard();
  const measure::PictureStatistics truth = independent_runs(
                                       place, with_estimator(render::Estimator::reference), side,
                                       16, 16, 5000),
                                   ours =
                                       independent_runs(place, half_rate(render::Estimator::traced),
                                                        side, 800, 1, 1);
  const measure::PixelTest verdict = measure::test_pixels(ours, truth, 0.01, 1e-4);
  double squares = 0, truth_squares = 0;
  for (std::size_t i = 0; i < truth.pixels(); ++i) {
    const double off = ours.mean(i) - truth.mean(i);
    squares += off * off - ours.variance_of_mean(i);
    truth_squares += truth.mean(i) * truth.mean(i);
  }
  const double rms = std::sqrt(std::max(squares, 0.0) / truth_squares);
  std::printf("  mean off by %+.3f %% +- %.3f %%, pixels by %.2f %% (root mean square)\n",
              100 * verdict.relative_mean, 100 * verdict.relative_mean_error, 100 * rms);
  EXPECT_LT(std::abs(verdict.relative_mean), 0.01 + 4 * verdict.relative_mean_error);
  EXPECT_LT(rms, 0.2);
}

// Air is sampled for one pixel of a block in turn, and its turns come in frames of both kinds.
TEST(HalfRate, AirIsUnbiasedInAMeanAtRest) {
  const LitPlace place = lit_courtyard();
  render::RenderSettings settings = half_rate(render::Estimator::traced);
  settings.air = {.visibility_km = 0.1f, .candidates = 8, .block = 2};
  render::RenderSettings exact = with_estimator(render::Estimator::reference);
  exact.air = settings.air;
  const measure::PictureStatistics truth = independent_runs(place, exact, side, 16, 32, 5000);
  expect_equal(independent_runs(place, settings, side, 64, 48, 1), truth, 1e-4, 1);
}

// Sizes that are no multiple of a group's, odd ones among them, and pictures of a pixel.
TEST(HalfRate, EverySizeIsSampledInTwoFrames) {
  const LitPlace place = lit_courtyard();
  render::RenderSettings settings = half_rate(render::Estimator::ris);
  settings.environment.sky_cd_m2 = glm::vec3(1);
  const scene::RenderScene plane = SceneBuilder(0.5f).ground(50).with({});
  for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{1u, 7u}, std::pair{7u, 1u},
                                      std::pair{9u, 17u}, std::pair{16u, 8u}, std::pair{33u, 5u}})
    for (const std::uint32_t frames : {1u, 2u}) {
      const measure::Image image =
          render(plane, {{0, 20, 0}, {0, 0, 0}, {0, 0, -1}, 40}, settings, width, height, frames);
      for (std::size_t i = 0; i < image.pixels(); ++i)
        EXPECT_NEAR(luminance(image, i), 0.5, 1e-4) << width << " x " << height << ", " << i;
    }
}

// Layers are sums of sampled light, so pictures with layers have every pixel sampled.
TEST(HalfRate, IsOffWhereLayersOrTheReferenceAreAskedFor) {
  const LitPlace place = lit_courtyard();
  render::RenderSettings settings = half_rate(render::Estimator::traced);
  for (const bool layers : {true, false}) {
    settings.sampling.layers = layers;
    if (!layers) settings.sampling.estimator = render::Estimator::reference;
    render::RenderSettings whole = settings;
    whole.sampling.half_rate = false;
    const measure::Image a = render(place.scene(), place.pose, settings, 32, 24, 2),
                         b = render(place.scene(), place.pose, whole, 32, 24, 2);
    EXPECT_EQ(a.rgb, b.rgb);
    EXPECT_EQ(a.info.estimator.find("half rate"), std::string::npos);
  }
}

TEST(HalfRate, PicturesNameItsBias) {
  const LitPlace place = lit_courtyard();
  const render::RenderSettings settings = half_rate(render::Estimator::traced);
  EXPECT_NE(render(place.scene(), place.pose, settings, 16, 12, 1).info.estimator.find("biased"),
            std::string::npos);
  const std::string at_rest = render(place.scene(), place.pose, settings, 16, 12, 2).info.estimator;
  EXPECT_NE(at_rest.find("half rate"), std::string::npos);
  EXPECT_EQ(at_rest.find("biased"), std::string::npos);
}

// The denoiser takes the mean as it is, filled or not; a frame may have the full rate after one of
// half, and the other way round.
TEST(HalfRate, IsDenoisedAndChangesFromFrameToFrame) {
  const LitPlace place = lit_courtyard();
  const scene::RenderScene scene = place.scene();
  render::DeviceScene device_scene(test_device(), scene);
  const double truth = mean_luminance(
      render(scene, place.pose, with_estimator(render::Estimator::reference), 64, 48, 8));
  render::Renderer renderer(test_device(), test_passes(), device_scene, 64, 48);
  render::RenderSettings settings = with_estimator(render::Estimator::traced);
  settings.display.denoise = true;
  for (int frame = 0; frame < 12; ++frame) {
    renderer.begin_frame(place.pose, settings, {.half_rate = frame % 3 != 0});
    while (!renderer.continue_frame(1, 1)) {
    }
    EXPECT_NEAR(mean_luminance(renderer.download(false)) / truth, 1, 0.05) << frame;
  }
}

}  // namespace
}  // namespace nightcity::test
