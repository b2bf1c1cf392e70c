// The sky of a city against published figures: the air of a clear night, Walker's law of how a
// city's glow falls off, and how clouds over a city brighten it.
#include "runtime/scene/skyglow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/scenes.h"

namespace nightcity::scene {
namespace {

using std::numbers::pi;

double luminance(const glm::dvec3& rgb) {
  return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

// Returns a round city with the upward light that Garstang (1986) takes for his: a share F goes
// straight up, near the horizon, and the ground reflects G of the rest as a matt surface does.
CityGlow make_city(double lumen, double radius_m) {
  constexpr double straight = 0.15, reflectance = 0.15;
  CityGlow glow;
  constexpr int steps = 180;  // of a band
  for (std::size_t band = 0; band < CityGlow::bands; ++band)
    for (int i = 0; i < steps; ++i) {
      const double elevation = (double(band) + (i + 0.5) / steps) * 5 * pi / 180;
      const double zenith = pi / 2 - elevation;
      const double candela = lumen / (2 * pi) *
                             (2 * reflectance * (1 - straight) * std::cos(zenith) +
                              0.554 * straight * std::pow(zenith, 4));
      glow.band_share[band] += candela * 2 * pi * std::cos(elevation) * (5 * pi / 180 / steps);
    }
  for (const double flux : glow.band_share) glow.reflected_lm += flux;
  for (double& share : glow.band_share) share /= glow.reflected_lm;
  constexpr int side = 24;
  const double cell = 2 * radius_m / side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 place((x + 0.5) * cell - radius_m, (y + 0.5) * cell - radius_m);
      if (std::hypot(place.x, place.y) < radius_m)
        glow.sources.push_back({place, cell / std::sqrt(pi), 1});
    }
  for (CityGlow::Source& source : glow.sources)
    source.flux_lm = glow.reflected_lm / double(glow.sources.size());
  return glow;
}

// Garstang's function sends up F + G (1 - F) of the lamps' light.
TEST(Skyglow, TheCityOfTheTestsSendsUpWhatGarstangsDoes) {
  EXPECT_NEAR(make_city(1000, 1000).flux_lm(), 1000 * (0.15 + 0.85 * 0.15), 5);
}

// Clarity 1 is a night of 0.33 magnitudes of extinction and a visibility of 26 km (Cinzano, Falchi,
// Elvidge: The first world atlas of the artificial night sky brightness, 2001).
TEST(Skyglow, TheAirOfAClearNightIsAsPublished) {
  EXPECT_NEAR(1.0857 * zenith_depth({}), 0.33, 0.02);
  EXPECT_NEAR(3.912 / extinction_at({}, 0) / 1000, 26, 2);
}

TEST(Skyglow, AerosolsScatterAllThatTheyTake) {
  double sum = 0;
  constexpr int steps = 18000;
  for (int i = 0; i < steps; ++i) {
    const double angle = (i + 0.5) * 180 / steps;
    sum += aerosol_phase(angle) * 2 * pi * std::sin(angle * pi / 180) * pi / steps;
  }
  EXPECT_NEAR(sum, 1, 0.01);
}

// Walker (1977): 45 degrees high towards a city, its glow is 0.01 P / d^2.5 of the natural sky,
// with P people at d km; Garstang checks his model against it, with 1,000 lm a head.
TEST(Skyglow, FallsOffAsWalkerMeasured) {
  constexpr double people = 1e5;
  const CityGlow city = make_city(people * 1000, 3000);
  const glm::dvec3 towards(-std::sqrt(0.5), std::sqrt(0.5), 0);
  for (const double km : {10.0, 20.0, 30.0, 50.0}) {
    const double glow =
        luminance(sky_luminance(city, {}, {km * 1000, 0}, towards)) - natural_sky_cd_m2;
    const double walker = 0.01 * people * std::pow(km, -2.5);
    EXPECT_NEAR(std::log2(glow / natural_sky_cd_m2 / walker), 0, 0.6) << km << " km";
  }
}

// Kyba et al.: Cloud coverage acts as an amplifier for ecological light pollution in urban
// ecosystems, 2011: overcast, the sky over Berlin is 10.1 times as bright.
TEST(Skyglow, CloudsOverACityOfBerlinsSizeMakeItTenTimesAsBright) {
  const CityGlow berlin = make_city(3.6e6 * 1000, 14'000);
  const glm::dvec3 up(0, 1, 0);
  const double clear = luminance(sky_luminance(berlin, {}, {0, 0}, up)),
               overcast = luminance(sky_luminance(berlin, {.overcast = true}, {0, 0}, up));
  EXPECT_GT(overcast / clear, 8);
  EXPECT_LT(overcast / clear, 13);
}

TEST(Skyglow, IsBrighterTowardsTheHorizonAndBluerUpHigh) {
  const CityGlow city = make_city(1e8, 3000);
  const auto at = [&](double zenith_deg) {
    const double z = zenith_deg * pi / 180;
    return sky_luminance(city, {}, {0, 0}, {std::sin(z), std::cos(z), 0});
  };
  EXPECT_GT(luminance(at(80)), 4 * luminance(at(0)));
  EXPECT_GT(at(0).b / at(0).r, at(88).b / at(88).r);
}

TEST(Skyglow, OfADarkPlaceIsTheNaturalSky) {
  const SkyMap map = make_skyglow({}, {}, {});
  ASSERT_EQ(map.rgb.size(), std::size_t{3} * map.width * map.height);
  EXPECT_NEAR(map.rgb[0], natural_sky_cd_m2, 1e-6 * natural_sky_cd_m2);
  EXPECT_EQ(map.rgb.back(), 0) << "below the horizon";
  EXPECT_NEAR(make_skyglow({}, {.overcast = true}, {}).rgb[0], 0, 1e-15);
}

TEST(Skyglow, OfFluxesBeyondAllMeasureIsFinite) {
  for (const bool overcast : {false, true})
    for (const float value :
         make_skyglow(make_city(1e45, 500), {.overcast = overcast}, {{-9, 0, -9}, {9, 5, 9}}).rgb)
      ASSERT_TRUE(std::isfinite(value));
}

// The map interpolates between few directions: within 6 % from 5 degrees up, and within a quarter
// close to the horizon, where a ray runs along the roofs of the city.
TEST(Skyglow, TheMapIsTheLuminanceWithinAFewPercent) {
  const CityGlow city = make_city(1e9, 4000);
  const SkyMap map = make_skyglow(city, {}, {{-1500, 0, -500}, {2500, 5, 900}});
  for (const double elevation_deg : {2.0, 5.0, 13.0, 40.0, 75.0})
    for (const double azimuth_deg : {10.0, 100.0, 215.0, 350.0}) {
      const auto y = static_cast<std::uint32_t>((90 - elevation_deg) / 180 * map.height);
      const auto x = static_cast<std::uint32_t>((azimuth_deg + 180) / 360 * map.width) % map.width;
      const double e = pi / 2 - (y + 0.5) * pi / map.height,
                   a = ((x + 0.5) / map.width - 0.5) * 2 * pi;
      const glm::dvec3 truth =
          sky_luminance(city, {}, {500, 200},
                        {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)});
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(map.rgb[3 * (std::size_t{y} * map.width + x) + std::size_t(c)] / truth[c], 1,
                    elevation_deg < 5 ? 0.25 : 0.06)
            << elevation_deg << " " << azimuth_deg;
    }
}

// The columns of the map go from south over west to north, east and south.
TEST(Skyglow, TheMapLooksTowardsTheCity) {
  CityGlow east = make_city(1e9, 2000);
  for (CityGlow::Source& source : east.sources) source.place.x += 15'000;
  const SkyMap map = make_skyglow(east, {}, {{-10, 0, -10}, {10, 5, 10}});
  const auto at = [&](double turn) {
    const auto column = static_cast<std::uint32_t>(turn * map.width);
    return map.rgb[3 * (std::size_t{map.height / 2 - 2} * map.width + column) + 1];
  };
  EXPECT_GT(at(0.75), 3 * at(0.25));
  EXPECT_NEAR(at(0.5) / at(0), 1, 0.2);
}

// The shares that a map carries give the upward light of another time as a map made then does.
TEST(CitySky, FollowsTheLightsToAnotherTime) {
  SceneLights lights;
  lights.lights = test::to_large(test::random_lamps(60, 90, 5));
  lights.families.assign(lights.lights.size(), LightFamily::lamp);
  for (std::size_t i = 0; i < lights.lights.size(); i += 3) lights.lights[i].schedule = 0;
  lights.schedules = {{0, 2}};
  lights.switches = {8 * 3600, 11 * 3600};
  const RenderScene scene =
      make_render_scene(test::random_town(20, 60, 3).scene(), std::move(lights));
  const auto sky_at = [&](double hour, LightFamilies on = all_families) {
    return make_city_sky(scene, hour * 3600, on, {}, 5000);
  };
  const CitySky evening = sky_at(9), night = sky_at(12);
  ASSERT_LT(night.glow.flux_lm(), 0.9 * evening.glow.flux_lm());
  const auto upward_of = [&](const CitySky& sky, bool late) {
    glm::dvec3 sum(0);
    for (const SkyMap::Share& share : sky.map.shares) {
      const Light& light = scene.lights[share.light];
      if (late && light.schedule != LIGHT_ALWAYS_ON) continue;
      sum += double{light.flux_lm} * glm::dvec3(share.per_lumen);
    }
    return luminance(sum);
  };
  EXPECT_NEAR(upward_of(evening, false), evening.glow.flux_lm(), 1e-4 * evening.glow.flux_lm());
  EXPECT_NEAR(upward_of(evening, true) / night.glow.flux_lm(), 1, 0.03);
  EXPECT_NEAR(upward_of(night, false) / evening.glow.flux_lm(), 1, 0.03);
  // A city in which nothing shines gets the map of all its lights.
  const CitySky dark = sky_at(9, LightFamilies{});
  EXPECT_EQ(dark.glow.flux_lm(), 0);
  EXPECT_NEAR(luminance(dark.map.upward_lm) / evening.glow.flux_lm(), 1, 0.03);
}

}  // namespace
}  // namespace nightcity::scene
