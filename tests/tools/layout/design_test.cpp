// Illuminance under rows of lamps against closed forms, and the designs that follow from it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/layout/layout_design.h"
#include "tools/layout/road_illuminance.h"
#include "tools/lights/optics.h"

namespace nightcity::layout {
namespace {

constexpr double pi = std::numbers::pi;

lights::Photometry one_lumen(lights::Photometry photometry) {
  const double flux = lights::integrated_flux(photometry);
  for (double& value : photometry.values) value /= flux;
  return photometry;
}

/// I = I0 cos(gamma) below the horizontal: a Lambertian disc of one lumen, I0 = 1 / pi.
lights::Photometry cosine() {
  return lights::sample_intensity(
      [](double, double gamma) { return std::max(0.0, std::cos(gamma)) / pi; }, 1, 721);
}

double untagged_width_m(const char* highway) {
  return roads::read_carriageway({{"highway", highway}})->width_m;
}

TEST(Illuminance, BelowALampItIsIntensityOverHeightSquared) {
  const lights::Photometry profile = cosine();
  const RoadLuminaire lamp{{3, 4}, 8, {0, 1}, 0, 5000, &profile};
  EXPECT_NEAR(illuminance(lamp, {3, 4}), 5000 / pi / 64, 1e-9);
  // At 45 degrees: cos^3, times the cosine of the profile.
  EXPECT_NEAR(illuminance(lamp, {11, 4}), 5000 / pi / 64 * std::pow(0.5, 2), 1e-3);
}

TEST(Illuminance, ATiltedLampIsBrightestWhereItPoints) {
  const lights::Photometry profile = one_lumen(lights::sample_intensity(
      [](double, double gamma) { return gamma < pi / 2 ? std::pow(std::cos(gamma), 20) : 0; }, 4,
      361));
  const RoadLuminaire lamp{{0, 0}, 10, {1, 0}, 30, 1000, &profile};
  const double there = std::tan(pi / 6) * 10;
  EXPECT_GT(illuminance(lamp, {there, 0}), 5 * illuminance(lamp, {-there, 0}));
  EXPECT_NEAR(illuminance(lamp, {3, 2}), illuminance(lamp, {3, -2}), 1e-9);
}

TEST(Illuminance, TheProfilesCSideLiesRightOfTheAim) {
  // C = 90 degrees is cross(down, aim): the right-hand side seen from above.
  const lights::Photometry profile = one_lumen(
      lights::sample_intensity([](double c, double) { return 1.5 + std::sin(c); }, 72, 91));
  const RoadLuminaire lamp{{0, 0}, 5, {0, 1}, 0, 1000, &profile};
  EXPECT_GT(illuminance(lamp, {4, 0}), 2 * illuminance(lamp, {-4, 0}));
}

/// Sum over a row of isotropic lamps of I cos^3 / h^2, lamps at every multiple of `spacing`.
double isotropic_row(double x, double y, double h, double spacing) {
  double sum = 0;
  for (int k = -4000; k <= 4000; ++k) {
    const double dx = x - k * spacing;
    sum += h / std::pow(dx * dx + y * y + h * h, 1.5) / (4 * pi);
  }
  return sum;
}

TEST(Illuminance, ARowOfIsotropicLampsMeetsTheSumOfCosinesCubed) {
  for (const double spacing : {12.0, 24.0, 36.0}) {
    LampRow row{Arrangement::central, 3, spacing, 8, 0, 1000, nullptr};
    const FieldSummary field = row_illuminance(row);
    // The field's points, one lane wide: three rows at y = -1, 0, 1.
    const int along = std::max(10, static_cast<int>(std::ceil(spacing / 3)));
    double average = 0, least = 1e9;
    for (int i = 0; i < along; ++i)
      for (const double y : {-1.0, 0.0, 1.0}) {
        const double e = 1000 * isotropic_row((i + 0.5) * spacing / along, y, 8, spacing);
        average += e / (3 * along);
        least = std::min(least, e);
      }
    EXPECT_NEAR(field.average_lx, average, 0.01 * average);
    EXPECT_NEAR(field.min_lx, least, 0.01 * least);
  }
}

TEST(Illuminance, TheAverageOfADenseRowIsThatOfALine) {
  // An endless line of isotropic emitters, phi lumens a metre, h above and y beside: E = phi / (2
  // pi) h / (y^2 + h^2); its mean over a road of half width b is phi / (2 pi b) atan(b / h).
  const double h = 6, width = 9.75, spacing = 1;
  LampRow row{Arrangement::central, width, spacing, h, 0, 200, nullptr};
  EXPECT_NEAR(row_illuminance(row).average_lx,
              200 / (2 * pi * width / 2) * std::atan(width / 2 / h),
              0.01 * 200 / (2 * pi * width / 2) * std::atan(width / 2 / h));
}

TEST(Illuminance, TwoSidesGiveTwiceTheLightOfOneAndStaggeringKeepsTheAverage) {
  const lights::Photometry profile = one_lumen(lights::make_optic(lights::Optic::street));
  LampRow row{Arrangement::single, 9.75, 24, 8, 0.5, 6000, &profile};
  const FieldSummary single = row_illuminance(row);
  row.arrangement = Arrangement::opposite;
  EXPECT_NEAR(row_illuminance(row).average_lx, 2 * single.average_lx, 1e-6 * single.average_lx);
  row.arrangement = Arrangement::staggered;
  const FieldSummary staggered = row_illuminance(row);
  EXPECT_NEAR(staggered.average_lx, single.average_lx, 0.02 * single.average_lx);
}

TEST(LampDesign, WiderRoadsGetLampsOnBothSides) {
  EXPECT_EQ(arrangement_for(6, 6), Arrangement::single);
  EXPECT_EQ(arrangement_for(9, 6), Arrangement::staggered);
  EXPECT_EQ(arrangement_for(12, 6), Arrangement::opposite);
}

TEST(LampDesign, PackagesNeverFallShortNorExceedByMoreThanAStep) {
  for (double flux = min_package_lm; flux < max_package_lm; flux *= 1.0173) {
    const double package = luminaire_package(flux);
    EXPECT_GE(package, flux * (1 - 1e-9));
    EXPECT_LE(package, flux * 1.15);
    EXPECT_EQ(luminaire_package(package), package);
  }
  EXPECT_EQ(luminaire_package(1), min_package_lm);
  EXPECT_EQ(luminaire_package(1e9), max_package_lm);
}

TEST(LampDesign, EveryRoadOfTheTableReachesTheAverageOfItsClassAndNotTheNextOne) {
  for (const char* highway :
       {"motorway", "primary", "secondary", "tertiary", "unclassified", "residential",
        "living_street", "service", "pedestrian", "footway", "cycleway"}) {
    const lights::RoadLighting road = *lights::find_road_lighting(highway);
    const lights::LightingClass wanted = *lights::lighting_class(road.target);
    const lights::Photometry profile = one_lumen(lights::make_optic(road.optic));
    const double width_m = untagged_width_m(highway);
    const LampDesign design =
        design_lamps(road, width_m, arrangement_for(width_m, road.mounting_m), wanted, profile);
    const double maintained = design.field.average_lx * lights::maintenance_factor;
    EXPECT_GE(maintained, wanted.average_lx) << highway;
    EXPECT_LE(maintained, wanted.average_lx * lights::max_excess) << highway;
    EXPECT_GE(design.spacing_m, 2.0 * road.mounting_m - 1e-9) << highway;
    EXPECT_LE(design.spacing_m, 3.0 * road.mounting_m + 1e-9) << highway;
  }
}

TEST(LampDesign, MappedLampsOfTheTableReachTheirClassAtThreeHeightsAndDoNotDoubleIt) {
  for (const char* highway :
       {"motorway", "primary", "secondary", "tertiary", "unclassified", "residential"}) {
    const lights::RoadLighting road = *lights::find_road_lighting(highway);
    const lights::Photometry profile = one_lumen(lights::make_optic(road.optic));
    LampRow row;
    row.width_m = untagged_width_m(highway);
    row.spacing_m = 3 * road.mounting_m;
    row.height_m = road.mounting_m;
    row.overhang_m = road.outreach_m - setback_m(road);
    row.flux_lm = road.flux_lm;
    row.profile = &profile;
    const double maintained = row_illuminance(row).average_lx * lights::maintenance_factor;
    EXPECT_GE(maintained, lights::lighting_class(road.target)->average_lx) << highway;
    EXPECT_LE(maintained, 2 * lights::lighting_class(road.target)->average_lx) << highway;
  }
}

}  // namespace
}  // namespace nightcity::layout
