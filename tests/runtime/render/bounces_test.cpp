// Light that bounces, against closed forms: rooms in which every surface sees the same.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/render/upward_flux.h"
#include "support/city_glow.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using std::numbers::pi;

enum class Way { reference, paths, cache };

render::RenderSettings with_bounces(Way way, std::uint32_t bounces) {
  render::RenderSettings settings = with_estimator(
      way == Way::reference ? render::Estimator::reference : render::Estimator::traced, 8);
  settings.indirect.bounces = bounces;
  settings.indirect.cache = way == Way::cache;
  return settings;
}

class Bounces : public testing::TestWithParam<Way> {};

INSTANTIATE_TEST_SUITE_P(Ways, Bounces, testing::Values(Way::reference, Way::paths, Way::cache),
                         [](const auto& info) {
                           return std::string(info.param == Way::reference ? "Reference"
                                              : info.param == Way::paths   ? "Paths"
                                                                           : "Cache");
                         });

// The furnace: in a closed room whose walls glow alike with luminance L and reflect the share rho,
// every wall shows L (1 + rho + rho^2 + ...), one term for each bounce.
TEST_P(Bounces, InAFurnaceEachAddsOneTermOfAGeometricSeries) {
  constexpr float rho = 0.5f, glow = 2;
  const scene::RenderScene room = SceneBuilder(rho).box({-3, 0, -4}, {5, 6, 3}).glow(glow).with({});
  const scene::CameraPose inside{{0.5f, 2, 0.3f}, {4, 3, 2}, {0, 1, 0}, 70};
  for (const std::uint32_t bounces : {0u, 1u, 2u, 5u}) {
    const measure::Image image =
        render(room, inside, with_bounces(GetParam(), bounces), 16, 16, 64);
    const double expected = double(glow) * (1 - std::pow(double(rho), bounces + 1)) / (1 - rho);
    // The first two bounces follow every path; later ones end paths by chance.
    const double tolerance = bounces <= 1 ? 1e-5 : GetParam() == Way::cache ? 0.01 : 0.02;
    EXPECT_NEAR(mean_luminance(image), expected, tolerance * expected) << bounces << " bounces";
  }
}

// A furnace does not ask where it stands: 140 km away, bounces neither leak nor shadow themselves.
TEST_P(Bounces, FarFromTheOriginAreTheSame) {
  constexpr float rho = 0.5f, glow = 2;
  const glm::vec3 far(1e5f, 0, -1e5f);
  const scene::RenderScene room = SceneBuilder(rho)
                                      .box(far + glm::vec3(-3, 0, -4), far + glm::vec3(5, 6, 3))
                                      .glow(glow)
                                      .with({});
  const scene::CameraPose inside{
      far + glm::vec3(0.5f, 2, 0.3f), far + glm::vec3(4, 3, 2), {0, 1, 0}, 70};
  const measure::Image image = render(room, inside, with_bounces(GetParam(), 3), 16, 16, 64);
  const double expected = double(glow) * (1 - std::pow(double(rho), 4)) / (1 - rho);
  EXPECT_NEAR(mean_luminance(image), expected, 0.02 * expected);
}

// Light whose products leave the range of floating point is lost, and nothing else is.
TEST_P(Bounces, OfFluxesBeyondAllMeasureStayFinite) {
  const scene::RenderScene room =
      SceneBuilder(0.9f)
          .box({-3, 0, -4}, {5, 6, 3})
          .with({lamp({0, 3, 0}, 3e38f), lamp({1, 3, 1}, 1e-38f), lamp({2, 5.9999f, 1}, 1000)});
  const measure::Image image = render(room, {{0.5f, 2, 0.3f}, {4, 3, 2}, {0, 1, 0}, 70},
                                      with_bounces(GetParam(), 4), 16, 16, 8);
  for (const float value : image.rgb) EXPECT_TRUE(std::isfinite(value));
}

// Rings of quads; seen from inside they are close to a sphere about the origin. The first `open`
// rings at the top are left out.
SceneBuilder sphere(float radius, float rho, int rings, int open = 0) {
  SceneBuilder builder(rho);
  const auto at = [&](int ring, int segment) {
    const double theta = pi * ring / rings, phi = pi * segment / rings;
    return radius * glm::vec3(float(std::sin(theta) * std::cos(phi)), float(std::cos(theta)),
                              float(std::sin(theta) * std::sin(phi)));
  };
  for (int ring = open; ring < rings; ++ring)
    for (int segment = 0; segment < 2 * rings; ++segment)
      builder.quad(at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1),
                   at(ring, segment + 1));
  return builder;
}

// The integrating sphere: a lamp of flux Phi in its centre lights the wall with Phi / (4 pi r^2),
// and every bounce adds rho times as much as the one before: E = Phi / (4 pi r^2) / (1 - rho).
TEST_P(Bounces, InAnIntegratingSphereEachAddsRhoTimesTheOneBefore) {
  constexpr float radius = 10, rho = 0.6f, flux_lm = 100'000;
  const scene::RenderScene scene = sphere(radius, rho, 48).with({lamp({0, 0, 0}, flux_lm, 0.1f)});
  const scene::CameraPose inside{{1, 2, 0}, {9, 0, 1}, {0, 1, 0}, 60};
  // The cache has few cells, and so few samples, in a small picture.
  const std::uint32_t side = GetParam() == Way::cache ? 48 : 16;
  for (const std::uint32_t bounces : {1u, 4u}) {
    const measure::Image image =
        render(scene, inside, with_bounces(GetParam(), bounces), side, side, 48);
    const double direct = double(rho) / pi * double(flux_lm) / (4 * pi * double(radius * radius));
    const double expected = direct * (1 - std::pow(double(rho), bounces + 1)) / (1 - double(rho));
    EXPECT_NEAR(mean_luminance(image), expected, 0.01 * expected) << bounces << " bounces";
  }
}

// Two parallel planes of albedo rho that glow: each sees nothing but the other.
TEST_P(Bounces, BetweenParallelPlanesEachSeesOnlyTheOther) {
  constexpr float rho = 0.3f, glow = 5;
  const scene::RenderScene planes =
      SceneBuilder(rho).ground(4000).ground(4000, 2).glow(glow).with({});
  const scene::CameraPose between{{0, 1, 0}, {2, 0, 1}, {0, 1, 0}, 20};
  const measure::Image image = render(planes, between, with_bounces(GetParam(), 3), 8, 8, 64);
  const double expected = double(glow) * (1 - std::pow(double(rho), 4)) / (1 - rho);
  EXPECT_NEAR(mean_luminance(image), expected, 0.01 * expected);
}

// Returns the illuminance above a lamp, at a height of `above` over a plane of albedo `rho` that
// faces it, by the light that the plane reflects once. The lamp hangs `gap` over the plane; lx.
double illuminance_off_a_plane(double rho, double flux_lm, double gap, double above) {
  double sum = 0;
  constexpr int steps = 200'000;
  for (int i = 0; i < steps; ++i) {
    // Rings whose radius grows by a constant factor, from far below the gap to far above `above`.
    const double range = std::log(1e7), u = (i + 0.5) / steps;
    const double s = gap * 1e-3 * std::exp(range * u), ds = s * range / steps;
    const double lit = flux_lm / (4 * pi) * gap / std::pow(gap * gap + s * s, 1.5);
    const double way2 = above * above + s * s;
    sum += rho / pi * lit * (above * above / (way2 * way2)) * 2 * pi * s * ds;
  }
  return sum;
}

// A lamp 2 cm above a floor makes a spot of a few square centimetres, which shines a thousand times
// brighter than all else, and lights the ceiling. Hardly a path from there meets it; a ray from the
// lamp does. With a housing, which casts no shadow, it is the same.
TEST_P(Bounces, OffTheHotSpotBesideALampLightsTheCeiling) {
  constexpr float rho = 0.5f, flux_lm = 1000, gap = 0.02f, height = 3;
  for (const bool has_housing : {false, true}) {
    SceneBuilder builder = SceneBuilder(rho).ground(4000).ground(4000, height);
    if (has_housing) {
      Scene& scene = builder.scene();
      scene.meshes.push_back(
          SceneBuilder(rho).box({-0.05f, 0.015f, -0.05f}, {0.05f, 0.06f, 0.05f}).scene().meshes[0]);
      scene.nodes.push_back({"housing", "lamp", 1, false, {SceneInstance{}}});
    }
    const scene::RenderScene scene = builder.with({lamp({0, gap, 0}, flux_lm, 0.002f)});
    render::RenderSettings settings = with_bounces(GetParam(), 1);
    const scene::CameraPose up{{0.5f, 1, 0}, {0, height, 0}, {0, 1, 0}, 2};
    const int frames = GetParam() == Way::paths ? 1024 : 64;
    const double both = mean_luminance(render(scene, up, settings, 8, 8, frames));
    settings.indirect.bounces = 0;
    const double direct = mean_luminance(render(scene, up, settings, 8, 8, frames));
    const double expected = rho / pi * illuminance_off_a_plane(rho, flux_lm, gap, height);
    EXPECT_NEAR(both - direct, expected, 0.01 * expected) << "housing: " << has_housing;
  }
}

// The paths that a sky is made from, on the host, find the flux of those on the device.
TEST(UpwardFlux, IsThatOfTheSkysPaths) {
  const scene::RenderScene scene =
      random_town(30, 60, 7).with(under_open_sky(random_town(30, 60, 7), random_lamps(40, 50, 8)));
  const scene::CityGlow glow = find_city_glow(scene, 0, scene::all_families, 65536);
  render::DeviceScene device_scene(test_device(), scene);
  render::UpwardSettings settings;
  settings.bounces = 4;
  const render::UpwardFlux flux =
      render::measure_upward_flux(test_device(), test_passes(), device_scene, settings);
  double direct = 0, reflected = 0;
  for (std::size_t i = 0; i < flux.lights.size(); ++i) {
    direct += flux.flux_lm[i] * flux.lights[i].direct;
    reflected += flux.flux_lm[i] * flux.lights[i].reflected;
  }
  EXPECT_NEAR(glow.direct_lm / direct, 1, 0.02);
  EXPECT_NEAR(glow.reflected_lm / reflected, 1, 0.02);
}

// An integrating sphere with a hole that is the share f of its area: of the light that reaches the
// wall or is reflected by it, f leaves. So do f of the lamp's own, and of the rest rho f (1 + rho
// (1 - f) + ...) after bounces.
TEST(UpwardFlux, OutOfASphereWithAHoleIsAGeometricSeries) {
  constexpr float rho = 0.7f;
  constexpr int rings = 48, open = 12;
  // As many lamps in one place as give each bounce enough rays.
  constexpr int lamps = 12;
  const scene::RenderScene scene =
      sphere(1, rho, rings, open).with(std::vector(lamps, lamp({0, 0, 0}, 1000, 0.01f)));
  const double f = (1 - std::cos(pi * open / rings)) / 2, stays = double(rho) * (1 - f);
  for (const std::uint32_t bounces : {0u, 1u, 3u, MAX_BOUNCES}) {
    render::DeviceScene device_scene(test_device(), scene);
    render::UpwardSettings settings;
    settings.bounces = bounces;
    settings.rays = 1 << 15;
    const render::UpwardFlux flux =
        render::measure_upward_flux(test_device(), test_passes(), device_scene, settings);
    const double expected = stays * f * (1 - std::pow(stays, bounces)) / (1 - stays);
    double direct = 0, reflected = 0;
    for (const auto& light : flux.lights) {
      direct += light.direct / lamps;
      reflected += light.reflected / lamps;
    }
    EXPECT_NEAR(direct, f, 0.005);
    EXPECT_NEAR(reflected, expected, 0.01 * expected + 1e-9) << bounces;
  }
}

// Light that bounced is a layer of its own, and the layers sum to the picture.
TEST_P(Bounces, AreALayerOfTheirOwn) {
  render::RenderSettings settings = with_bounces(GetParam(), 2);
  settings.sampling.layers = true;
  const measure::Image image =
      render(boxes_on_a_plane().with({lamp({-6, 7, 0}, 6000, 0.3f)}),
             {{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50}, settings, 16, 16, 8);
  const measure::ImageLayer* indirect = nullptr;
  std::vector<double> sums(image.rgb.size());
  for (const measure::ImageLayer& layer : image.layers) {
    if (layer.name == "indirect") indirect = &layer;
    if (layer.name.starts_with("direct_") || layer.name == "sky" || layer.name == "emitted" ||
        layer.name == "indirect")
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += double(layer.values[i]);
  }
  ASSERT_NE(indirect, nullptr);
  double bounced = 0;
  for (const float value : indirect->values) bounced += double(value);
  EXPECT_GT(bounced, 0);
  for (std::size_t i = 0; i < sums.size(); ++i)
    EXPECT_NEAR(sums[i], image.rgb[i], 1e-4 * double(image.rgb[i]) + 1e-7) << i;
}

}  // namespace
}  // namespace nightcity::test
