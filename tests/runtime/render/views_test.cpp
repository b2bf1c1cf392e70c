// Views of a picture in false colours, as the device writes them, against those of files.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/measure/false_colour.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

using test::lamp;
using test::SceneBuilder;

class Views : public testing::Test {
 protected:
  Views()
      : scene(make_scene()),
        on_device(test::test_device(), scene),
        renderer(test::test_device(), test::test_passes(), on_device, width, height) {}

  static scene::RenderScene make_scene() {
    scene::SceneLights lights;
    lights.lights = {lamp({-4, 6, 0}, 3000), lamp({5, 4, 1}, 800)};
    lights.families = {LightFamily::lamp, LightFamily::window};
    return scene::make_render_scene(SceneBuilder().ground(30).box({-8, 0, -4}, {8, 5, -3}).scene(),
                                    std::move(lights));
  }
  void render(const RenderSettings& settings, int frames = 4) {
    for (int i = 0; i < frames; ++i)
      renderer.render_frame({{0, 12, 14}, {0, 1, 0}, {0, 1, 0}, 60}, settings);
  }
  std::vector<std::uint32_t> show(std::uint32_t view, double lowest, double highest) {
    DisplaySettings display;
    display.view = view;
    display.view_lowest = float(lowest);
    display.view_highest = float(highest);
    renderer.expose(display);
    return renderer.display().read<std::uint32_t>(std::size_t{width} * height);
  }
  // Compares with a picture of a file.
  void expect_like(std::uint32_t view, const std::vector<float>& values, const char* what) {
    const measure::ColourScale scale{0.01, 100, "lx"};
    const auto words = show(view, scale.lowest, scale.highest);
    const measure::Image8 file = measure::false_colour(values, width, height, scale);
    for (std::size_t i = 0; i < words.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(int(words[i] >> (8 * c) & 255), int{file.rgb[3 * i + c]}, 2) << what << i;
  }

  static constexpr std::uint32_t width = 40, height = 24;
  scene::RenderScene scene;
  DeviceScene on_device;
  Renderer renderer;
};

TEST_F(Views, HaveTheColoursThatFilesHave) {
  RenderSettings settings;
  settings.sampling.layers = true;
  settings.indirect.bounces = 2;
  render(settings);
  const measure::Image image = renderer.download();
  using measure::Illumination;
  expect_like(VIEW_LUMINANCE, measure::luminance_of(image), "luminance ");
  expect_like(VIEW_ILLUMINANCE, measure::illuminance_of(image), "illuminance ");
  expect_like(VIEW_DIRECT, measure::illuminance_of(image, Illumination::direct), "direct ");
  expect_like(VIEW_INDIRECT, measure::illuminance_of(image, Illumination::indirect), "indirect ");
}

TEST_F(Views, WithoutLayersWhatNeedsThemIsThePicture) {
  render({});
  EXPECT_EQ(show(VIEW_KINDS, 1, 2), show(VIEW_PICTURE, 1, 2));
  EXPECT_NE(show(VIEW_LUMINANCE, 0.01, 100), show(VIEW_PICTURE, 1, 2));
}

TEST_F(Views, NoiseFallsWithTheNumberOfFramesAndOneFrameHasNone) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::ris;  // frames are independent
  settings.sampling.candidates = 1;
  settings.sampling.jitter = false;
  // A share of the scale, by the sum of the colour's channels, which grows along it.
  const auto mean_share = [&] {
    double sum = 0;
    for (const std::uint32_t word : show(VIEW_NOISE, 1e-4, 1)) {
      double nearest = 1e9, share = 0;
      for (int k = 0; k <= 200; ++k) {
        const auto rgb = measure::colour_at(k / 200.0);
        double distance = 0;
        for (std::size_t c = 0; c < 3; ++c)
          distance += std::abs(double(word >> (8 * c) & 255) - double(rgb[c]));
        if (distance < nearest) share = k / 200.0;
        nearest = std::min(nearest, distance);
      }
      sum += share;
    }
    return sum / (width * height);
  };
  render(settings, 1);
  EXPECT_EQ(mean_share(), 0);
  render(settings, 15);
  const double few = mean_share();
  render(settings, 16 * 16 - 16);
  // A quarter of the noise is log10(4) of the four decades; noise found from 16 frames varies.
  EXPECT_NEAR(few - mean_share(), std::log10(4.0) / 4, 0.06);
}

TEST_F(Views, HistoryGrowsWithTheFramesAndTheReferenceHasNone) {
  RenderSettings settings;
  const auto brightest = [&] {
    std::uint32_t most = 0;
    for (const std::uint32_t word : show(VIEW_HISTORY, 1, 100))
      most = std::max(most, word >> 8 & 255);
    return most;
  };
  render(settings, 1);
  const std::uint32_t first = brightest();
  render(settings, 16);
  EXPECT_GT(brightest(), first + 20);
  settings.sampling.estimator = Estimator::reference;
  render(settings, 1);
  EXPECT_EQ(brightest(), 0u);
}

}  // namespace
}  // namespace nightcity::render
