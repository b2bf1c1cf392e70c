// Copies for other programs keep the light's lumens under the falloff that those programs use.
#include "tools/bake/scene/punctual.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/rgb9e5.h"
#include "tools/lights/optics.h"

namespace nightcity::bake {
namespace {

using std::numbers::pi;

/// The extension's recommended falloff, integrated over the sphere.
double flux_of(const ScenePunctual& light) {
  if (light.outer_rad == 0) return 4 * pi * light.intensity_cd;
  constexpr int steps = 20000;
  const double inner = std::cos(light.inner_rad), outer = std::cos(light.outer_rad);
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    const double angle = (n + 0.5) * pi / steps;
    const double t = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
    sum += light.intensity_cd * t * t * 2 * pi * std::sin(angle) * pi / steps;
  }
  return sum;
}

Light light_of(LightKind kind, uint profile) {
  Light light{};
  light.axis = {0, -1, 0};
  light.tangent = {1, 0, 0};
  light.radius = 0.5f;
  light.half_height = 0.5f;
  light.flux_lm = 5000;
  light.colour_rgb9e5 = encode_rgb9e5({1.6f, 0.9f, 0.2f});
  light.kind_profile = pack_kind_profile(kind, profile);
  return light;
}

TEST(Punctual, EveryKindOfLightKeepsItsLumens) {
  lights::ProfileTable table;
  const uint street = table.add("street", lights::make_optic(lights::Optic::street)),
             lantern = table.add("lantern", lights::make_optic(lights::Optic::lantern));
  for (const Light& light :
       {light_of(LightKind::sphere, LIGHT_NO_PROFILE), light_of(LightKind::sphere, street),
        light_of(LightKind::sphere, lantern), light_of(LightKind::rectangle, LIGHT_NO_PROFILE)})
    EXPECT_NEAR(flux_of(to_punctual(light, table.profiles, table.data)), 5000, 5000 * 0.002);
}

TEST(Punctual, WhatShinesDownIsASpotAndWhatShinesAroundAPoint) {
  lights::ProfileTable table;
  const uint street = table.add("street", lights::make_optic(lights::Optic::street)),
             lantern = table.add("lantern", lights::make_optic(lights::Optic::lantern));
  const auto outer = [&](const Light& light) {
    return to_punctual(light, table.profiles, table.data).outer_rad;
  };
  EXPECT_GT(outer(light_of(LightKind::sphere, street)), pi / 4);
  EXPECT_LT(outer(light_of(LightKind::sphere, street)), pi / 2);
  EXPECT_EQ(outer(light_of(LightKind::sphere, lantern)), 0);
  EXPECT_EQ(outer(light_of(LightKind::sphere, LIGHT_NO_PROFILE)), 0);
  // On its axis a window has the intensity of a Lambertian emitter.
  const ScenePunctual window =
      to_punctual(light_of(LightKind::rectangle, LIGHT_NO_PROFILE), {}, {});
  EXPECT_NEAR(window.intensity_cd, 5000 / pi, 5000 / pi * 0.005);
}

TEST(Punctual, TheBrightestAreKeptInTheirOrder) {
  BrightestLights brightest(3);
  for (const float flux : {5.0f, 1.0f, 9.0f, 7.0f, 2.0f, 7.0f, 3.0f}) {
    Light light = light_of(LightKind::sphere, LIGHT_NO_PROFILE);
    light.flux_lm = flux;
    brightest.add(light);
  }
  const std::vector<Light> kept = std::move(brightest).take();
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].flux_lm, 9);
  EXPECT_EQ(kept[1].flux_lm, 7);
  EXPECT_EQ(kept[2].flux_lm, 7);
  BrightestLights none(0);
  none.add(light_of(LightKind::sphere, LIGHT_NO_PROFILE));
  EXPECT_TRUE(std::move(none).take().empty());
}

}  // namespace
}  // namespace nightcity::bake
