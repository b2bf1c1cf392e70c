// Views of a picture in false colours, as the device writes them, against those of files.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "runtime/measure/exposure.h"
#include "runtime/measure/false_colour.h"
#include "runtime/scene/trace_ray.h"
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

TEST_F(Views, WithoutLayersHitsOrReferenceWhatNeedsThemIsThePicture) {
  render({});
  EXPECT_EQ(show(VIEW_KINDS, 1, 2), show(VIEW_PICTURE, 1, 2));
  EXPECT_EQ(show(VIEW_TILES, 1, 2), show(VIEW_PICTURE, 1, 2));
  EXPECT_EQ(show(VIEW_WIREFRAME, 1, 2), show(VIEW_PICTURE, 1, 2));
  EXPECT_EQ(show(VIEW_DIFFERENCE, 1, 2), show(VIEW_PICTURE, 1, 2));
  EXPECT_NE(show(VIEW_LUMINANCE, 0.01, 100), show(VIEW_PICTURE, 1, 2));
}

// At the edges of the box, sub-pixels matter: frames that keep what a view shows have the
// same mean, to the last bit, and so the same exposure.
TEST_F(Views, AreMeteredAsThePicture) {
  const auto mean_for = [&](std::uint32_t view) {
    RenderSettings settings;
    keep_what_view_needs(view, settings.sampling);
    settings.sampling.layers = false;  // these compile other shaders, which round differently
    Renderer fresh(test::test_device(), test::test_passes(), on_device, width, height);
    for (int i = 0; i < 4; ++i)
      fresh.render_frame({{0, 12, 14}, {0, 1, 0}, {0, 1, 0}, 60}, settings);
    return fresh.sample_mean(std::size_t{width} * height);
  };
  const measure::Image picture = mean_for(VIEW_PICTURE);
  for (const std::uint32_t view : {VIEW_WIREFRAME, VIEW_TILES, VIEW_OBJECTS, VIEW_DIFFERENCE}) {
    const measure::Image other = mean_for(view);
    EXPECT_EQ(other.rgb, picture.rgb) << view;
    EXPECT_EQ(measure::auto_exposure_ev100(other), measure::auto_exposure_ev100(picture)) << view;
  }
}

std::array<int, 3> bytes_of(std::uint32_t word) {
  return {int(word & 255), int(word >> 8 & 255), int(word >> 16 & 255)};
}

// The reference has fewer pixels: each of its pixels is compared with all that it covers.
TEST_F(Views, TheDifferenceIsSignedAndRelativeToTheReference) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::ris;
  settings.sampling.candidates = 1;
  render(settings, 2);
  Renderer reference(test::test_device(), test::test_passes(), on_device, width / 2, height / 2);
  settings.sampling.estimator = Estimator::reference;
  for (int i = 0; i < 3; ++i)
    reference.render_frame({{0, 12, 14}, {0, 1, 0}, {0, 1, 0}, 60}, settings);
  DisplaySettings display;
  display.view = VIEW_DIFFERENCE;
  display.view_highest = 0.5f;
  renderer.expose(display, &reference);
  const auto words = renderer.display().read<std::uint32_t>(std::size_t{width} * height);
  const std::vector<float> mean = measure::luminance_of(renderer.download()),
                           truth = measure::luminance_of(reference.download());
  std::size_t darker = 0, brighter = 0;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t i = std::size_t{y} * width + x;
      const double a = double(mean[i]), b = double(truth[y / 2 * (width / 2) + x / 2]);
      const auto shown = bytes_of(words[i]);
      if (b == 0 && a == 0) {
        EXPECT_EQ(shown, (std::array<int, 3>{0, 0, 0})) << x << " " << y;
        continue;
      }
      const auto expected = measure::signed_colour_at(b > 0 ? (a / b - 1) / 0.5 : 1);
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(shown[c], int{expected[c]}, 2) << x << " " << y;
      (a < b ? darker : brighter) += a != b;
    }
  EXPECT_GT(darker, 100u);
  EXPECT_GT(brighter, 100u);
}

// Each tile has one colour, and no two have the same; what is seen of each is found on the host.
TEST(TilesView, HasAColourForEachInstance) {
  test::SceneBuilder builder = SceneBuilder().box({-1, 0, -1}, {1, 2, 1});
  auto& places = builder.scene().nodes[0].instances;
  for (const float x : {-6.0f, -3.0f, 3.0f, 6.0f}) {
    places.emplace_back();
    places.back().to_model[3] = {x, 0, 0, 1};
  }
  const scene::RenderScene scene = builder.with({});
  const scene::CameraPose pose{{0, 9, 14}, {0, 1, 0}, {0, 1, 0}, 60};
  constexpr std::uint32_t width = 60, height = 40;
  RenderSettings settings;
  keep_what_view_needs(VIEW_TILES, settings.sampling);
  DeviceScene on_device(test::test_device(), scene);
  Renderer renderer(test::test_device(), test::test_passes(), on_device, width, height);
  for (int i = 0; i < 3; ++i) renderer.render_frame(pose, settings);  // at other sub-pixels
  DisplaySettings display;
  display.view = VIEW_TILES;
  renderer.expose(display);
  const auto words = renderer.display().read<std::uint32_t>(std::size_t{width} * height);
  const gpu::Camera camera = scene::make_camera(pose, float(width) / height);
  std::map<std::uint32_t, std::set<std::uint32_t>> colours;  // by instance, NO_HIT for the sky
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const double right = (2 * (x + 0.5) / width - 1) * double(camera.tan_half_height) *
                           double(camera.aspect),
                   up = (1 - 2 * (y + 0.5) / height) * double(camera.tan_half_height);
      const glm::dvec3 direction = glm::dvec3(camera.forward) + right * glm::dvec3(camera.right) +
                                   up * glm::dvec3(camera.up);
      const auto hit =
          scene::trace_ray(scene, glm::dvec3(pose.position), direction, 1e9, MASK_VISIBLE);
      colours[hit ? hit->instance : NO_HIT].insert(words[std::size_t{y} * width + x]);
    }
  ASSERT_EQ(colours.size(), 6u);
  std::set<std::uint32_t> all;
  for (const auto& [instance, shown] : colours) {
    EXPECT_EQ(shown.size(), 1u) << instance;
    all.insert(shown.begin(), shown.end());
  }
  EXPECT_EQ(all.size(), colours.size());
  EXPECT_EQ(colours[NO_HIT], std::set<std::uint32_t>{0xFF000000u});
}

// A square of 32 x 32 x 2 triangles of one size, all seen: eight pieces share its area evenly.
TEST(TilesView, PiecesHaveTheSameNumberOfTriangles) {
  SceneBuilder builder;
  for (int x = -16; x < 16; ++x)
    for (int z = -16; z < 16; ++z) {
      const auto at = [&](int dx, int dz) { return glm::vec3(x + dx, 0, z + dz); };
      builder.quad(at(0, 0), at(0, 1), at(1, 1), at(1, 0));
    }
  const scene::RenderScene scene = builder.with({});
  constexpr std::uint32_t side = 256;
  RenderSettings settings;
  keep_what_view_needs(VIEW_TILES, settings.sampling);
  DeviceScene on_device(test::test_device(), scene);
  Renderer renderer(test::test_device(), test::test_passes(), on_device, side, side);
  renderer.render_frame({{0, 45, 0}, {0, 0, 0}, {0, 0, -1}, 40}, settings);
  DisplaySettings display;
  display.view = VIEW_TILES;
  renderer.expose(display);
  std::map<std::uint32_t, std::size_t> pixels;
  for (const std::uint32_t word : renderer.display().read<std::uint32_t>(side * side))
    ++pixels[word];
  const double background = double(pixels[0xFF000000u]), all = side * side - background;
  EXPECT_GT(all, side * side / 2);
  EXPECT_EQ(pixels.size(), 1 + 32u * 32 * 2 / TILE_TRIANGLES);
  for (const auto& [colour, count] : pixels) {
    if (colour == 0xFF000000u) continue;
    EXPECT_NEAR(double(count) / all, 1 / 8.0, 0.01) << colour;
  }
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const double t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::distance(p, a + t * (b - a));
}

// A square on an unlit ground, seen from above, aslant, and so near that a corner lies behind the
// camera: lines lie along its sides and its diagonal, two pixels wide and fading from the middle.
TEST(Wireframe, LinesAreAsWideFromNearAndFar) {
  const scene::RenderScene scene = SceneBuilder().ground(5).with({});
  constexpr std::uint32_t width = 96, height = 64;
  RenderSettings settings;
  keep_what_view_needs(VIEW_WIREFRAME, settings.sampling);
  DeviceScene on_device(test::test_device(), scene);
  Renderer renderer(test::test_device(), test::test_passes(), on_device, width, height);
  for (const scene::CameraPose& pose :
       {scene::CameraPose{{0.3f, 30, 0.2f}, {0, 0, 0}, {0, 0, -1}, 40},
        scene::CameraPose{{0.3f, 90, 0.2f}, {0, 0, 0}, {0, 0, -1}, 40},
        scene::CameraPose{{8, 4, 14}, {0, 0, 0}, {0, 1, 0}, 50},
        scene::CameraPose{{3, 1, 3.5f}, {-5, 0, -5}, {0, 1, 0}, 60}}) {
    for (int i = 0; i < 3; ++i) renderer.render_frame(pose, settings);
    DisplaySettings display;
    display.view = VIEW_WIREFRAME;
    renderer.expose(display);
    const auto words = renderer.display().read<std::uint32_t>(std::size_t{width} * height);
    const gpu::Camera camera = scene::make_camera(pose, float(width) / height);
    const glm::dvec3 corners[4] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    // In the camera's frame, cut off where it lies behind: x and y over depth, then pixels.
    const auto to_camera = [&](glm::dvec3 p) {
      const glm::dvec3 way = p - glm::dvec3(pose.position);
      return glm::dvec3(glm::dot(way, glm::dvec3(camera.right)),
                        glm::dot(way, glm::dvec3(camera.up)),
                        glm::dot(way, glm::dvec3(camera.forward)));
    };
    const auto to_pixel = [&](glm::dvec3 p) {
      const double scale = height / (2 * p.z * double(camera.tan_half_height));
      return glm::dvec2(width / 2.0 + p.x * scale, height / 2.0 - p.y * scale);
    };
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;
    for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}) {
      glm::dvec3 a = to_camera(corners[from]), b = to_camera(corners[to]);
      if (a.z > b.z) std::swap(a, b);
      if (b.z < 0.01) continue;
      if (a.z < 0.01) a += (b - a) * (0.01 - a.z) / (b.z - a.z);
      lines.emplace_back(to_pixel(a), to_pixel(b));
    }
    std::size_t drawn = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        double nearest = 1e9, to_end = 1e9;
        for (const auto& [a, b] : lines) {
          nearest = std::min(nearest, distance_to_segment(centre, a, b));
          to_end = std::min({to_end, glm::distance(centre, a), glm::distance(centre, b)});
        }
        if (to_end < 4) continue;  // outlines are mitred there
        const double cover = std::max(0.0, 1 - nearest);
        const auto shown = bytes_of(words[std::size_t{y} * width + x]);
        constexpr std::array colour{WIRE_COLOUR};
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(shown[c], cover * colour[c], 4) << pose.position.y << ": " << x << " " << y;
        drawn += cover > 0;
      }
    EXPECT_GT(drawn, 15u);
  }
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
