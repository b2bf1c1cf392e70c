// The light that leaves a city upwards, against closed forms.
#include "runtime/scene/city_glow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/city_glow.h"
#include "support/scenes.h"

namespace nightcity::scene {
namespace {

using test::find_city_glow;
using test::lamp;
using test::SceneBuilder;

// A bare lamp sends half its light up and half down, where a wide ground of reflectance 0.5 throws
// half of that back up, as a matt surface does: a share of cos^2(a) - cos^2(b) between two angles
// from the zenith.
TEST(CityGlow, OfALampOverAPlaneIsTheClosedForm) {
  const RenderScene scene = SceneBuilder(0.5f).ground(5000).with({lamp({0, 5, 0}, 1000)});
  const CityGlow glow = find_city_glow(scene, 0, all_families, 65536);
  EXPECT_EQ(glow.lamp_flux_lm, 1000);
  EXPECT_NEAR(glow.direct_lm, 500, 8);
  EXPECT_NEAR(glow.reflected_lm, 250, 4);
  EXPECT_NEAR(std::accumulate(glow.band_share.begin(), glow.band_share.end(), 0.0), 1, 1e-9);
  for (std::size_t band = 0; band < CityGlow::bands; ++band) {
    const double low = double(band) * 5 * M_PI / 180, high = low + 5 * M_PI / 180;
    const double direct = 500 * (std::sin(high) - std::sin(low)),
                 reflected = 250 * (std::pow(std::sin(high), 2) - std::pow(std::sin(low), 2));
    EXPECT_NEAR(glow.band_share[band] * glow.flux_lm(), direct + reflected, 5) << band;
  }
  double sources = 0;
  for (const CityGlow::Source& source : glow.sources) sources += source.flux_lm;
  EXPECT_NEAR(sources, glow.flux_lm(), 1e-6 * sources);
}

// A window's light leaves into the half space before it: half of it upwards.
TEST(CityGlow, OfAWindowIsHalfOfItsLight) {
  const RenderScene scene =
      SceneBuilder(0).ground(5000).with({test::window({0, 5, 0}, {0, 0, 1}, 1, 1, 300)});
  const CityGlow glow = find_city_glow(scene, 0);
  EXPECT_NEAR(glow.direct_lm, 150, 5);
  EXPECT_EQ(glow.reflected_lm, 0);
}

TEST(CityGlow, RoofsHideLampsAndSwitchedOffOnesGiveNone) {
  const std::vector<Light> lights{lamp({0, 5, 0}, 1000)};
  const RenderScene roofed =
      SceneBuilder(0).ground(50).box({-200, 6, -200}, {200, 7, 200}).with(lights);
  const CityGlow under = find_city_glow(roofed, 0);
  EXPECT_LT(under.flux_lm(), 20);
  const RenderScene open = SceneBuilder(0).ground(50).with(lights);
  EXPECT_EQ(find_city_glow(open, 0, LightFamilies{}).flux_lm(), 0);
  EXPECT_EQ(find_city_glow(SceneBuilder().ground(5).with({}), 0).flux_lm(), 0);
}

TEST(CityGlow, IsTheSameEveryTime) {
  const RenderScene scene = test::random_town(20, 60, 3).with(test::random_lamps(20, 60, 4));
  const CityGlow a = find_city_glow(scene, 0), b = find_city_glow(scene, 0);
  EXPECT_EQ(a.direct_lm, b.direct_lm);
  EXPECT_EQ(a.reflected_lm, b.reflected_lm);
  EXPECT_GT(a.flux_lm(), 0);
}

// The city around the scene shines as the scene does on average.
TEST(CityGlow, GoesOnAroundTheScene) {
  const RenderScene scene = SceneBuilder(0.5f).ground(500).with({lamp({0, 5, 0}, 1e6f)});
  CityGlow glow = find_city_glow(scene, 0);
  const double inside = glow.flux_lm();
  extend_city(glow, scene.bounds, 5000);
  double all = 0;
  for (const CityGlow::Source& source : glow.sources) all += source.flux_lm;
  EXPECT_NEAR(all / inside, M_PI * 5000.0 * 5000 / 1e6, 0.05);
  CityGlow same = find_city_glow(scene, 0);
  const std::size_t count = same.sources.size();
  extend_city(same, scene.bounds, 100);
  EXPECT_EQ(same.sources.size(), count);
}

}  // namespace
}  // namespace nightcity::scene
