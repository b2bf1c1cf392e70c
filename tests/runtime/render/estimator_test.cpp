// Estimators against the reference, and the reference against a CPU oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/error.h"
#include "runtime/scene/brute_force.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

const scene::CameraPose pose{{-45, 25, 50}, {0, 2, 0}, {0, 1, 0}, 50};

// A small radius and a short history: otherwise all pixels of so small a picture share a few
// samples, and its mean is noisy.
render::RenderSettings settings_of(render::Estimator estimator) {
  return with_estimator(estimator, 16, 6, 4);
}

// Lights small enough to be points: the oracle then needs no area sampling.
std::vector<Light> point_lamps(int count, float half, unsigned seed) {
  std::vector<Light> lights = random_lamps(count, half, seed);
  for (Light& light : lights) light.radius = 0.001f;
  return lights;
}

double oracle_luminance(const scene::RenderScene& scene, const glm::dvec3& point,
                        const glm::dvec3& normal, double depth) {
  const glm::dvec3 origin =
      point + normal * 4e-6 *
                  std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), depth, 1.0});
  double sum = 0;
  for (const Light& light : scene.lights) {
    const glm::dvec3 to = glm::dvec3(light.position) - point;
    const double d2 = glm::dot(to, to), cosine = glm::dot(normal, to) / std::sqrt(d2);
    if (cosine <= 0) continue;
    if (scene::brute_force_hit(scene, origin, glm::dvec3(light.position) - origin, 0.99999,
                               MASK_SHADOW))
      continue;
    sum += 0.5 / std::numbers::pi * double(light.flux_lm) / (4 * std::numbers::pi) * cosine / d2;
  }
  return sum;
}

// More lights than one chunk holds, and so many steps that Debian 12's CPU driver would cut an
// unchunked loop short. Without layers, chunks go into slices side by side; with layers, one
// follows the other.
class Reference : public testing::TestWithParam<bool> {};

TEST_P(Reference, EqualsABruteForceOracleWithShadows) {
  const scene::RenderScene scene = random_town(50, 50, 11).with(point_lamps(300, 50, 5));
  render::RenderSettings settings = settings_of(render::Estimator::reference);
  settings.sampling.layers = GetParam();
  // Higher than wide, so that a mix-up of width and height is noticed.
  const measure::Image image = render(scene, pose, settings, 20, 28, 1);
  const auto& points = image.layer("position")->values;
  const auto& normals = image.layer("normal")->values;
  const auto& depths = image.layer("depth")->values;
  double sum = 0, expected_sum = 0;
  int wrong = 0, pixels = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (depths[i] <= 0) continue;
    ++pixels;
    const double expected = oracle_luminance(
        scene, {points[3 * i], points[3 * i + 1], points[3 * i + 2]},
        {normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]}, double(depths[i]));
    sum += luminance(image, i);
    expected_sum += expected;
    if (std::abs(luminance(image, i) - expected) > 0.002 * expected + 1e-6) ++wrong;
  }
  EXPECT_GT(pixels, 300);
  EXPECT_NEAR(sum / expected_sum, 1.0, 0.002);
  EXPECT_LE(wrong, pixels / 100);  // shadow edges within rounding
}

INSTANTIATE_TEST_SUITE_P(Slices, Reference, testing::Bool(), [](const auto& info) {
  return info.param ? "OneAfterTheOther" : "SideBySide";
});

// Returns the mean luminance of the pixels that are not among the brightest tenth of `truth`. Where
// a lamp nearly touches a wall, the estimate has so long a tail that a mean over those pixels says
// nothing. The selection does not depend on the estimate.
double body_mean(const measure::Image& image, const measure::Image& truth) {
  std::vector<double> sorted;
  for (std::size_t i = 0; i < truth.pixels(); ++i) sorted.push_back(luminance(truth, i));
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() * 9 / 10),
                   sorted.end());
  const double limit = sorted[sorted.size() * 9 / 10];
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < truth.pixels(); ++i)
    if (luminance(truth, i) < limit) {
      sum += luminance(image, i);
      count += 1;
    }
  return sum / count;
}

// tests/runtime/proof shows that each estimator but the paper's is unbiased.
class Estimators : public testing::Test {
 protected:
  static constexpr std::uint32_t side = 48;
  Estimators() {
    truth_ = render(scene_, pose, settings_of(render::Estimator::reference), side, side, 4);
  }
  // A lamp inside a wall would get the highest unshadowed target and never light anything: noise
  // that no real city has.
  SceneBuilder town_ = random_town(120, 50, 11);
  scene::RenderScene scene_ = town_.with(under_open_sky(town_, random_lamps(300, 50, 5)));
  measure::Image truth_;
};

TEST_F(Estimators, AMovingCameraReusesItsHistoryWithoutBias) {
  gpu::Device& device = test_device();
  render::DeviceScene device_scene(device, scene_);
  render::RenderSettings settings = settings_of(render::Estimator::traced);
  std::vector<double> ratios;
  for (std::uint32_t run = 0; run < 8; ++run) {
    settings.sampling.seed = run;
    render::Renderer renderer(device, test_passes(), device_scene, side, side);
    scene::CameraPose moving = pose;
    for (int i = 8; i >= 0; --i) {
      moving.position = pose.position + glm::vec3(0.3f * float(i), 0, 0.1f * float(i));
      renderer.render_frame(moving, settings);
    }
    EXPECT_EQ(renderer.frames(), 1u);  // the mean starts anew, the reservoirs do not
    ratios.push_back(body_mean(renderer.download(false), truth_) / body_mean(truth_, truth_) - 1);
  }
  double mean = 0;
  for (const double r : ratios) mean += r / double(ratios.size());
  EXPECT_NEAR(mean, 0.0, 0.03);
}

// In the first frame no pixel has a history.
TEST_F(Estimators, MoreNeighboursMakeUpForAMissingHistory) {
  render::RenderSettings settings = settings_of(render::Estimator::traced);
  const auto error = [&](std::uint32_t boost) {
    settings.reuse.disocclusion_boost = boost;
    const measure::Image image = render(scene_, pose, settings, side, side, 1);
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      sum += std::abs(luminance(image, i) - luminance(truth_, i));
    return sum;
  };
  EXPECT_LT(error(16), 0.9 * error(0));
}

// A red and a blue lamp in one place give the same luminance, and each pixel of a frame draws one
// of them. Half of all pairs then draw one of each, and their pixels show both: three parts of
// their own, whose weight is 1/2 + 1/2 (1 - 1/2), and one of their partner's.
TEST(Pairs, APixelShowsTheColoursOfAllSamplesThatItCombines) {
  Light red = lamp({0, 200, 0}, 5e6f), blue = red;
  red.colour_rgb9e5 = encode_rgb9e5({1 / 0.2126f, 0, 0});
  blue.colour_rgb9e5 = encode_rgb9e5({0, 0, 1 / 0.0722f});
  render::DeviceScene scene(test_device(), SceneBuilder().ground(50).with({red, blue}));
  const auto mixed_share = [&](std::uint32_t neighbours) {
    render::RenderSettings settings = with_estimator(render::Estimator::traced, 1, 5, 0);
    settings.reuse.neighbours = neighbours;
    settings.sampling.layers = true;
    render::Renderer renderer(test_device(), test_passes(), scene, 64, 64);
    renderer.render_frame(looking_down, settings);
    const measure::Image image = renderer.download();
    const auto& lamps = image.layer("direct_lamps")->values;
    std::size_t mixed = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const double r = 0.2126 * double(lamps[3 * i]), b = 0.0722 * double(lamps[3 * i + 2]);
      if (r == 0 || b == 0) continue;
      EXPECT_NEAR(std::max(r / b, b / r), 3, 0.03) << "pixel " << i;
      EXPECT_NEAR(double(image.rgb[3 * i]), double(lamps[3 * i]), 1e-6 * r);
      ++mixed;
    }
    return double(mixed) / double(image.pixels());
  };
  EXPECT_EQ(mixed_share(0), 0);
  EXPECT_NEAR(mixed_share(1), 0.5, 0.06);
}

// A pixel keeps one of a red and a blue lamp, as above, for some frames, so that its share of red
// in a mean varies from pixel to pixel. A frame with a history of h frames keeps that sample with
// the chance (h / (1 + h))^2, the pairwise weight of a history whose targets are its own, and two
// frames are alike where none between them took another. From the fifth frame of a picture at rest
// on, h is at most 5 where pixels span much.
TEST(History, IsShorterInMeansOfLargePixels) {
  constexpr int frames = 40;
  const auto expected_spread = [](double longest_at_rest) {
    double variance = 0;
    for (int i = 0; i < frames; ++i) {
      double alike = 1;
      for (int k = i; k < frames; ++k) {
        const double history = std::min<double>(k, k < 4 ? 20 : longest_at_rest);
        if (k > i) alike *= std::pow(history / (1 + history), 2);
        variance += (k > i ? 2 : 1) * alike / 4 / (frames * frames);
      }
    }
    return std::sqrt(variance);
  };
  Light red = lamp({0, 2000, 0}, 5e8f), blue = red;
  red.colour_rgb9e5 = encode_rgb9e5({1 / 0.2126f, 0, 0});
  blue.colour_rgb9e5 = encode_rgb9e5({0, 0, 1 / 0.0722f});
  render::DeviceScene scene(test_device(), SceneBuilder().ground(50).with({red, blue}));
  const auto measure_spread = [&](float height_m) {
    render::RenderSettings settings = with_estimator(render::Estimator::traced, 1, 5, 20);
    settings.reuse.neighbours = 0;
    render::Renderer renderer(test_device(), test_passes(), scene, 64, 64);
    const scene::CameraPose above{{0, height_m, 0}, {0, 0, 0}, {0, 0, -1}, 40};
    for (int i = 0; i < frames; ++i) renderer.render_frame(above, settings);
    const measure::Image image = renderer.download();
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const double r = 0.2126 * double(image.rgb[3 * i]), b = 0.0722 * double(image.rgb[3 * i + 2]);
      sum += (r / (r + b) - 0.5) * (r / (r + b) - 0.5);
    }
    return std::sqrt(sum / double(image.pixels()));
  };
  EXPECT_NEAR(measure_spread(6), expected_spread(20), 0.02);  // 0.07 m a pixel
  EXPECT_NEAR(measure_spread(60), expected_spread(5), 0.02);  // 0.7 m a pixel
}

// Some light would never be sampled, and the picture would silently be darker.
TEST(Shares, ThatLeaveSomeLightOutAreRefused) {
  render::RenderSettings settings;
  settings.sampling.near_share = 0.7f;
  settings.sampling.far_share = 0.3f;
  EXPECT_THROW(
      render(SceneBuilder().ground(30).with({lamp({3, 6, 0}, 4000)}), pose, settings, 4, 4, 1),
      UsageError);
  settings.sampling.far_share = 0.2f;
  settings.sampling.vehicle_share = 0;  // no vehicles: nobody misses them
  EXPECT_NO_THROW(
      render(SceneBuilder().ground(30).with({lamp({3, 6, 0}, 4000)}), pose, settings, 4, 4, 1));
}

// 1 / falloff^2 of so short a distance would be infinite, and the picture NaN.
TEST(Falloff, TheShortestOneCountsAsAMillimetre) {
  render::RenderSettings settings = settings_of(render::Estimator::traced);
  settings.reuse.history_falloff_m = 1e-30f;
  const scene::RenderScene scene = SceneBuilder().ground(30).with({lamp({3, 6, 0}, 4000)});
  const measure::Image shortest = render(scene, pose, settings, 8, 8, 3);
  settings.reuse.history_falloff_m = 0.001f;
  EXPECT_EQ(shortest.rgb, render(scene, pose, settings, 8, 8, 3).rgb);
  for (const float value : shortest.rgb) EXPECT_TRUE(std::isfinite(value));
}

// Leaving out unneeded features may only change the cost of a pass. A GPU's compiler may round
// differently in the longer pass, so that a random decision changes in a few pixels.
TEST_F(Estimators, PassesThatCouldDoWhatTheSceneLacksMakeTheSamePicture) {
  render::RenderSettings settings = settings_of(render::Estimator::traced);
  const measure::Image plain = render(scene_, pose, settings, 32, 32, 3);
  for (const render::Feature& feature : render::optional_features()) {
    settings.forced_features = 1u << feature.constant;
    const measure::Image other = render(scene_, pose, settings, 32, 32, 3);
    if (test_device().info().kind == "cpu") {
      EXPECT_EQ(plain.rgb, other.rgb) << feature.name;
      continue;
    }
    std::size_t differ = 0;
    for (std::size_t i = 0; i < plain.pixels(); ++i)
      differ += std::abs(luminance(plain, i) - luminance(other, i)) > 1e-4 * luminance(plain, i);
    EXPECT_LE(differ, plain.pixels() / 50) << feature.name;
  }
}

TEST_F(Estimators, TheSameSeedGivesTheSamePictureAndAnotherSeedAnother) {
  render::RenderSettings settings = settings_of(render::Estimator::traced);
  const measure::Image a = render(scene_, pose, settings, 32, 32, 3),
                       b = render(scene_, pose, settings, 32, 32, 3);
  EXPECT_EQ(a.rgb, b.rgb);
  settings.sampling.seed = 1;
  EXPECT_NE(a.rgb, render(scene_, pose, settings, 32, 32, 3).rgb);
}

}  // namespace
}  // namespace nightcity::test
