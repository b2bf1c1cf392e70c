// Plans are held to the standards' means by an integration of our own over the lights of the file.
#include "tools/map_lights/installation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/tools/lights/kept_schedules.h"
#include "tests/tools/map_lights/flat_ground.h"
#include "tools/lights/lighting_class.h"
#include "tools/map_lights/map_light_defaults.h"

namespace nightcity::map_lights {
namespace {

const Ground ground = test::make_flat_ground();

std::vector<glm::dvec2> make_ring(double length, double width) {
  return {{-length / 2, -width / 2},
          {length / 2, -width / 2},
          {length / 2, width / 2},
          {-length / 2, width / 2}};
}

// The light of a file, with its profile: candela towards a place of model space, by SPEC.md.
class FileLight {
 public:
  FileLight(const lights::PlacedLamp& lamp, const lights::Photometry& profile) : profile_(profile) {
    test::KeptSchedules schedules;
    light_ = lights::to_light(lamp, {}, schedules.table);
  }
  double find_illuminance(const glm::dvec3& place, const glm::dvec3& normal) const {
    const glm::dvec3 ray = place - glm::dvec3(light_.position), axis(light_.axis),
                     tangent(light_.tangent);
    const double d2 = glm::dot(ray, ray), cosine = -glm::dot(ray, normal) / std::sqrt(d2);
    if (cosine <= 0) return 0;
    const glm::dvec3 w = ray / std::sqrt(d2);
    const double c = std::atan2(glm::dot(w, glm::cross(axis, tangent)), glm::dot(w, tangent));
    const double gamma = std::acos(glm::clamp(glm::dot(w, axis), -1.0, 1.0));
    return double{light_.flux_lm} * lights::intensity_at(profile_, c, gamma) * cosine / d2;
  }

 private:
  lights::Photometry profile_;
  Light light_;
};

struct Field {
  double mean = 0, least = std::numeric_limits<double>::infinity();
};

// Over the ground of a rectangle about the origin, at the height of the ground, model space.
Field measure_ground(const Installation& plan, double length, double width) {
  std::vector<FileLight> lights;
  for (const lights::PlacedLamp& lamp : plan.lamps) lights.emplace_back(lamp, plan.profile);
  Field field;
  constexpr int n = 60;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 place(length * ((i + 0.5) / n - 0.5), 5, width * ((j + 0.5) / n - 0.5));
      double lx = 0;
      for (const FileLight& light : lights) lx += light.find_illuminance(place, {0, 1, 0});
      field.mean += lx / (n * n);
      field.least = std::min(field.least, lx);
    }
  return field;
}

TEST(Installation, PitchesHaveTheirMaintainedMeanAndTheUniformityOfClassThree) {
  struct Pitch {
    const char* sport;
    double length, width, uniformity;
  };
  // EN 12193 class III: 75 lx and 0.5 for football, 200 lx and 0.6 for tennis.
  for (const Pitch& pitch : {Pitch{"soccer", 105, 68, 0.5}, Pitch{"tennis", 36, 18, 0.6},
                             Pitch{"basketball", 28, 15, 0.5}}) {
    const auto ring = make_ring(pitch.length, pitch.width);
    auto plan = plan_pitch(ring, *find_box(ring), ground);
    ASSERT_TRUE(plan);
    const double wanted = find_pitch_lx(pitch.sport);
    ASSERT_TRUE(reach_mean(plan->lamps, plan->profile, plan->points, wanted));
    const Field field = measure_ground(*plan, pitch.length, pitch.width);
    EXPECT_NEAR(field.mean * lights::maintenance_factor, wanted, 0.02 * wanted) << pitch.sport;
    EXPECT_GE(field.least / field.mean, pitch.uniformity) << pitch.sport;
    RecordProperty(pitch.sport, std::to_string(field.least / field.mean));
    for (const lights::PlacedLamp& lamp : plan->lamps) {
      EXPECT_NEAR(std::abs(lamp.foot.y), pitch.width / 2 + 3, 1e-9);
      EXPECT_LT(lamp.aim.y * lamp.foot.y, 0);  // inward
      EXPECT_EQ(lamp.foot.z, 5);
    }
  }
}

TEST(Installation, NoLightOfAPitchGoesUp) {
  const auto ring = make_ring(105, 68);
  const auto plan = plan_pitch(ring, *find_box(ring), ground);
  EXPECT_EQ(plan->profile.extent_degrees, 90);
  for (const lights::PlacedLamp& lamp : plan->lamps) EXPECT_EQ(lamp.tilt_degrees, 0);
}

TEST(Installation, MastsInBuildingsAreNotThere) {
  Ground built = ground;
  built.inside = [](const glm::dvec2& p) { return p.y > 0; };
  const auto ring = make_ring(105, 68);
  const auto plan = plan_pitch(ring, *find_box(ring), built);
  ASSERT_TRUE(plan);
  for (const lights::PlacedLamp& lamp : plan->lamps) EXPECT_LT(lamp.foot.y, 0);
  built.inside = [](const glm::dvec2&) { return true; };
  EXPECT_FALSE(plan_pitch(ring, *find_box(ring), built));
}

TEST(Installation, AWallHasItsMaintainedMean) {
  const Box box{{0, 0}, {1, 0}, 40, 20};
  for (int side = 0; side < 4; ++side) {
    auto plan = plan_wall(box, side, 18, ground);
    ASSERT_TRUE(plan);
    ASSERT_TRUE(reach_mean(plan->lamps, plan->profile, plan->points, facade_lx));
    const bool is_end = side >= 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    const glm::dvec2 normal = is_end ? glm::dvec2(sign, 0) : glm::dvec2(0, sign);
    const double width = is_end ? 20 : 40, away = is_end ? 20 : 10;
    std::vector<FileLight> lights;
    for (const lights::PlacedLamp& lamp : plan->lamps) lights.emplace_back(lamp, plan->profile);
    double mean = 0;
    constexpr int n = 40;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const glm::dvec2 plan_place =
            normal * away + glm::dvec2(-normal.y, normal.x) * (width * ((i + 0.5) / n - 0.5));
        const glm::dvec3 place(plan_place.x, 5 + 18 * (j + 0.5) / n, -plan_place.y);
        for (const FileLight& light : lights)
          mean += light.find_illuminance(place, {normal.x, 0, -normal.y}) / (n * n);
      }
    EXPECT_NEAR(mean * lights::maintenance_factor, facade_lx, 0.03 * facade_lx) << side;
  }
}

TEST(Installation, FloodlightsComeNearerWhereABuildingStandsInTheWay) {
  const Box box{{0, 0}, {1, 0}, 40, 20};
  Ground built = ground;
  built.inside = [](const glm::dvec2& p) { return p.y > 10 + 4; };
  const auto plan = plan_wall(box, 0, 18, built);
  ASSERT_TRUE(plan);
  for (const lights::PlacedLamp& lamp : plan->lamps) {
    EXPECT_GT(lamp.foot.y, 10);
    EXPECT_LE(lamp.foot.y, 14);
  }
  built.inside = [](const glm::dvec2& p) { return p.y > 10; };
  EXPECT_FALSE(plan_wall(box, 0, 18, built));
}

TEST(Installation, AForecourtHasItsMaintainedMean) {
  const auto ring = make_ring(30, 12);
  auto plan = plan_downlights(ring, *find_box(ring), 4.7, ground);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->lamps.size(), 6u * 3u);  // a square grid of 4.7 m
  ASSERT_TRUE(reach_mean(plan->lamps, plan->profile, plan->points, canopy_lx));
  const Field field = measure_ground(*plan, 30, 12);
  EXPECT_NEAR(field.mean * lights::maintenance_factor, canopy_lx, 0.01 * canopy_lx);
}

TEST(Installation, ASolidBlockIsNoCanopyAndASlabOverTheLightsIs) {
  const auto ring = make_ring(30, 12);
  Ground built = ground;
  built.solid_at = [](const glm::dvec2&) { return std::optional(SolidSpan{5, 11}); };
  EXPECT_FALSE(plan_downlights(ring, *find_box(ring), 4.7, built));
  built.solid_at = [](const glm::dvec2&) { return std::optional(SolidSpan{10, 10.5}); };
  EXPECT_TRUE(plan_downlights(ring, *find_box(ring), 4.7, built));
}

}  // namespace
}  // namespace nightcity::map_lights
