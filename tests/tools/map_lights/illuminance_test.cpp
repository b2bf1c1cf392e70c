#include "tools/map_lights/illuminance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/lights/lighting_class.h"
#include "tools/map_lights/beams.h"

namespace nightcity::map_lights {
namespace {

using std::numbers::pi;

lights::PlacedLamp make_lamp(double height_m) {
  lights::PlacedLamp lamp;
  lamp.foot = {3, 4, 10};
  lamp.mounting_height_m = height_m;
  lamp.flux_lm = 1000;
  return lamp;
}

TEST(Illuminance, ADownlightGivesTheFourthPowerOfTheCosine) {
  const lights::Photometry downlight = make_downlight();
  const lights::PlacedLamp lamp = make_lamp(5);
  for (const double r : {0.0, 1.0, 5.0, 12.0}) {
    const double cosine = 5 / std::hypot(5, r);
    const double expected = 1000 / pi * std::pow(cosine, 4) / 25;
    EXPECT_NEAR(find_illuminance(lamp, downlight, {{3 + r, 4, 10}, {0, 0, 1}}), expected,
                1e-3 * expected);
  }
}

TEST(Illuminance, ADiscBelowADownlightGetsTheShareOfItsSolidAngle) {
  // Projected solid angle over pi: R^2 / (R^2 + h^2).
  const lights::Photometry downlight = make_downlight();
  const lights::PlacedLamp lamp = make_lamp(4);
  constexpr double radius = 6;
  constexpr int rings = 4000;
  double flux = 0;
  for (int i = 0; i < rings; ++i) {
    const double r = radius * (i + 0.5) / rings;
    flux += find_illuminance(lamp, downlight, {{3, 4 + r, 10}, {0, 0, 1}}) * 2 * pi * r * radius /
            rings;
  }
  EXPECT_NEAR(flux, 1000 * radius * radius / (radius * radius + 16), 1);
}

TEST(Illuminance, ATiltedBeamLightsWhatItAimsAtMost) {
  const lights::Photometry beam = make_spotlight();
  lights::PlacedLamp lamp = make_lamp(0.3);
  lamp.aim = {1, 0};
  lamp.tilt_degrees = 90 + 45;  // up, at a wall 5 m away, 5 m above the lamp
  const auto on_wall = [&](double height) {
    return find_illuminance(lamp, beam, {{8, 4, 10.3 + height}, {-1, 0, 0}});
  };
  EXPECT_GT(on_wall(5), on_wall(0));
  EXPECT_GT(on_wall(4), on_wall(9));
  EXPECT_EQ(find_illuminance(lamp, beam, {{-2, 4, 12}, {1, 0, 0}}), 0);  // behind
  EXPECT_EQ(find_illuminance(lamp, beam, {{8, 4, 14}, {1, 0, 0}}), 0);   // turned away
}

TEST(Illuminance, AWantedMeanIsReachedOrRefused) {
  const lights::Photometry downlight = make_downlight();
  std::vector<lights::PlacedLamp> lamps{make_lamp(5)};
  const std::vector<TargetPoint> below{{{3, 4, 10}, {0, 0, 1}}};
  ASSERT_TRUE(reach_mean(lamps, downlight, below, 100));
  EXPECT_NEAR(lamps[0].flux_lm, 100 / lights::maintenance_factor * pi * 25, 5);
  EXPECT_FALSE(reach_mean(lamps, downlight, std::vector<TargetPoint>{{{3, 4, 99}, {0, 0, 1}}}, 1));
  EXPECT_FALSE(reach_mean(lamps, downlight, below, 1e9));
  EXPECT_FALSE(reach_mean(lamps, downlight, {}, 100));
}

TEST(Illuminance, TwoSidesOfAnAreaAddUpToAnEvenFieldAcrossIt) {
  // Endless rows two mounting heights apart at x = 0 and x = reach, both aiming inward.
  for (const double reach : {2.0, 3.0, 4.25}) {
    const lights::Photometry beam = make_area_floodlight(reach);
    EXPECT_NEAR(lights::integrated_flux(beam), 1, 1e-9);
    const auto row = [&](double x, double y, double side) {
      double sum = 0;
      for (int k = -6; k <= 6; ++k) {
        lights::PlacedLamp lamp;
        lamp.foot = {side < 0 ? 0 : reach, 2.0 * k, 0};
        lamp.mounting_height_m = 1;
        lamp.flux_lm = 1;
        lamp.aim = {-side, 0};
        sum += find_illuminance(lamp, beam, {{x, y, 0}, {0, 0, 1}});
      }
      return sum;
    };
    double least = 1e9, most = 0;
    for (double x = 0.05; x < reach; x += reach / 17)
      for (double y = 0; y < 2; y += 0.25) {
        const double e = row(x, y, -1) + row(x, y, 1);
        least = std::min(least, e);
        most = std::max(most, e);
      }
    EXPECT_GT(least / most, 0.8) << reach;  // the ripple along the rows, and the table's steps
  }
}

}  // namespace
}  // namespace nightcity::map_lights
