// Distributions against closed forms, and the colours of kinds of lamp.
#include "tools/lights/photometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "formats/colour.h"
#include "support/data.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/luminaire.h"
#include "tools/lights/optics.h"

namespace nightcity::lights {
namespace {

using std::numbers::pi;

double luminance(const glm::vec3& rgb) {
  return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

TEST(LampColour, HasLuminanceOneAndNoNegativeChannel) {
  for (int type = 0; type < 8; ++type) {
    const auto& xy = lamp_type_defaults(static_cast<LampType>(type)).xy;
    if (!xy) continue;
    const glm::vec3 rgb = rec709_from_xy(*xy);
    EXPECT_NEAR(luminance(rgb), 1, 1e-3);
    EXPECT_GE(std::min({rgb.r, rgb.g, rgb.b}), 0);
  }
}

TEST(LampColour, SodiumIsOrange) {
  const glm::vec3 sodium = rec709_from_xy(*lamp_type_defaults(LampType::high_pressure_sodium).xy);
  const glm::vec3 candle = rec709_from_xy(planckian_xy(2000));
  EXPECT_GT(sodium.r, 1.5f * sodium.g);
  EXPECT_NEAR(sodium.b, 0, 1e-6);
  EXPECT_GT(glm::distance(sodium, candle), 0.02f);
}

/// Integrates the interpolant by a fine midpoint rule, independently of the closed form.
double quadrature(const Photometry& photometry) {
  constexpr int steps = 720;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double c = (i + 0.5) * 2 * pi / steps, gamma = (j + 0.5) * pi / steps;
      sum += intensity_at(photometry, c, gamma) * std::sin(gamma);
    }
  return sum * (2 * pi / steps) * (pi / steps);
}

TEST(Photometry, FluxOfKnownDistributionsIsTheClosedForm) {
  EXPECT_NEAR(integrated_flux(sample_intensity([](double, double) { return 1; }, 1, 2)), 4 * pi,
              1e-9);
  // Lambert's law gives I0 pi; only the interpolation of the grid differs.
  EXPECT_NEAR(integrated_flux(sample_intensity(
                  [](double, double g) { return std::max(0.0, std::cos(g)); }, 8, 181)),
              pi, pi * 1e-3);
  // cos^2(C) averages to a half.
  EXPECT_NEAR(integrated_flux(sample_intensity(
                  [](double c, double) { return std::cos(c) * std::cos(c); }, 36, 19)),
              2 * pi, 1e-9);
}

TEST(Photometry, InterpolationMeetsTheGridAndWraps) {
  const Photometry photometry =
      sample_intensity([](double c, double g) { return std::cos(c) + 2 + g; }, 8, 5);
  EXPECT_NEAR(intensity_at(photometry, 0, 0), 3, 1e-12);
  EXPECT_NEAR(intensity_at(photometry, 2 * pi, pi), 3 + pi, 1e-12);
  EXPECT_NEAR(intensity_at(photometry, -pi / 4, pi / 2), std::cos(pi / 4) + 2 + pi / 2, 1e-12);
  const double half = (std::cos(7 * pi / 4) + 1) / 2 + 2;  // between the last row and the first
  EXPECT_NEAR(intensity_at(photometry, 2 * pi - pi / 8, 0), half, 1e-12);
}

TEST(Photometry, EveryOpticIsOneLumenWithinHalfAPercentByIndependentQuadrature) {
  ProfileTable table;
  for (const Optic optic : {Optic::street, Optic::central, Optic::lantern, Optic::floodlight}) {
    const std::uint32_t index = table.add(name_of(optic), make_optic(optic));
    const LightProfile& profile = table.profiles[index];
    Photometry stored{profile.c_count, profile.gamma_count, {}};
    const float* first = table.data.data() + profile.data_offset;
    stored.values.assign(first,
                         first + static_cast<std::size_t>(profile.c_count) * profile.gamma_count);
    EXPECT_NEAR(quadrature(stored), 1, 0.005) << name_of(optic);
    for (const double value : stored.values) EXPECT_GE(value, 0);
  }
  EXPECT_EQ(table.profiles.size(), 4u);
  EXPECT_EQ(table.add("lantern", make_optic(Optic::lantern)), 2u);  // stored once
}

TEST(Photometry, StreetOpticsSendNoLightUpAndThrowAlongAndOverTheRoad) {
  for (const Optic optic : {Optic::street, Optic::central}) {
    const Photometry street = make_optic(optic);
    for (double c = 0; c < 2 * pi; c += 0.1)
      for (double gamma = pi / 2; gamma <= pi; gamma += 0.05)
        EXPECT_EQ(intensity_at(street, c, gamma), 0);
    double peak = 0, peak_gamma = 0;
    for (double gamma = 0; gamma < pi / 2; gamma += 0.01)
      if (const double value = intensity_at(street, pi / 2, gamma); value > peak)
        peak = value, peak_gamma = gamma;
    EXPECT_GT(peak_gamma * 180 / pi, 55);
    EXPECT_LT(peak_gamma * 180 / pi, 72);
    EXPECT_GT(peak, intensity_at(street, pi / 2, 0));
    const double klm =
        peak / integrated_flux(street) * 1000;  // real street luminaires: 300 to 800 cd/klm
    EXPECT_GT(klm, 250);
    EXPECT_LT(klm, 900);
    for (double gamma = 0; gamma < 1.5; gamma += 0.1)
      EXPECT_NEAR(intensity_at(street, 1, gamma), intensity_at(street, 2 * pi - 1, gamma), 1e-9);
  }
  const Photometry over = make_optic(Optic::street);
  EXPECT_GT(intensity_at(over, 0, pi / 4),
            3 * intensity_at(over, pi, pi / 4));  // little light goes to the houses
}

struct RoadFigures {
  double share, uniformity;  // of the flux on the road; least over average illuminance
};

/// A road as wide as its lamps are high, lamps on one side, 0.6 m over the kerb, four heights
/// apart.
RoadFigures light_a_road(const Photometry& photometry) {
  constexpr double height = 8, width = 8, spacing = 32;
  double sum = 0, least = 1e300;
  int points = 0;
  for (double x = spacing / 20; x < spacing; x += spacing / 10)
    for (double y = width / 12; y < width; y += width / 6, ++points) {
      double lux = 0;
      for (int n = -4; n <= 5; ++n) {
        const double forward = y - 0.6, along = x - n * spacing,
                     square = forward * forward + along * along + height * height;
        const double cosine = height / std::sqrt(square);
        lux += intensity_at(photometry, std::atan2(along, forward), std::acos(cosine)) * cosine /
               square;
      }
      sum += lux;
      least = std::min(least, lux);
    }
  return {sum / points * width * spacing / integrated_flux(photometry), least / (sum / points)};
}

TEST(Photometry, StreetOpticLightsARoadAsMeasuredLuminairesDo) {
  const RoadFigures analytic = light_a_road(make_optic(Optic::street));
  EXPECT_NEAR(analytic.share, 0.57, 0.03);
  EXPECT_NEAR(analytic.uniformity, 0.42, 0.04);
  for (const char* name :
       {"ies/eulumdat-rs_road_luminaire.ldt", "ies/eulumdat_OutdoorRoadway_60W_4000K.ies"}) {
    REAL_DATA(file, name);
    const RoadFigures measured = light_a_road(read_luminaire(file).photometry());
    EXPECT_NEAR(analytic.share, measured.share, 0.05) << name;
    EXPECT_NEAR(analytic.uniformity, measured.uniformity, 0.06) << name;
  }
}

TEST(Photometry, WhatIsNoDistributionIsRefused) {
  ProfileTable table;
  Photometry photometry = sample_intensity([](double, double) { return 1; }, 2, 3);
  photometry.values[1] = -1;
  EXPECT_THROW(table.add("a", photometry), std::invalid_argument);
  photometry.values[1] = NAN;
  EXPECT_THROW(table.add("a", photometry), std::invalid_argument);
  photometry.values.assign(6, 0.0);
  EXPECT_THROW(table.add("a", photometry), std::invalid_argument);
  EXPECT_TRUE(table.profiles.empty());
}

}  // namespace
}  // namespace nightcity::lights
