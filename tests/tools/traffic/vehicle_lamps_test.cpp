// Dipped beams and signal lamps meet their regulations in the profile that a renderer reads.
#include "tools/traffic/vehicle_lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "formats/night_check.h"
#include "formats/rgb9e5.h"

namespace nightcity::traffic {
namespace {

using std::numbers::pi;

/// Returns the candela of the lamp h degrees to the right of and v degrees above its axis, from
/// the stored profile.
class Beam {
 public:
  explicit Beam(Side side) {
    const VehicleLamps lamps = make_vehicle_lamps(side, profiles_);
    const Light& headlamp = lamps.lights[lamps.kinds[0].first_light];
    profile_ = profiles_.profiles[light_profile(headlamp)];
    flux_ = double{headlamp.flux_lm};
  }

  double at(double h_degrees, double v_degrees) const {
    const double h = h_degrees * pi / 180, v = v_degrees * pi / 180;
    const double forward = std::cos(v) * std::cos(h), right = std::cos(v) * std::sin(h),
                 up = std::sin(v);
    const double gamma = std::acos(forward) * 180 / pi, c = std::atan2(-up, right) * 180 / pi;
    if (gamma > double{profile_.extent_deg}) return 0;
    const double column = gamma / double{profile_.extent_deg} * (profile_.gamma_count - 1);
    const double row = (c < 0 ? c + 360 : c) / 360 * profile_.c_count;
    const auto g =
        std::min(static_cast<std::size_t>(column), std::size_t{profile_.gamma_count} - 2);
    const auto r = static_cast<std::size_t>(row);
    const auto value = [&](std::size_t i, std::size_t j) {
      return double{
          profiles_.data[profile_.data_offset + i % profile_.c_count * profile_.gamma_count + j]};
    };
    const double x = column - static_cast<double>(g), y = row - static_cast<double>(r);
    return flux_ * ((value(r, g) * (1 - x) + value(r, g + 1) * x) * (1 - y) +
                    (value(r + 1, g) * (1 - x) + value(r + 1, g + 1) * x) * y);
  }

 private:
  lights::ProfileTable profiles_;
  LightProfile profile_;
  double flux_;
};

struct TestPoint {
  const char* name;
  double h, v;
  double least, greatest;  // cd; 0: no limit
};

// UN Regulation 112, class B, traffic on the right.
constexpr TestPoint points[] = {
    {"B50L", -3.43, 0.57, 0, 350},   {"BR", 2.5, 1.0, 0, 1750},
    {"75R", 1.15, -0.57, 10100, 0},  {"75L", -3.43, -0.57, 0, 10600},
    {"50L", -3.43, -0.86, 0, 13200}, {"50R", 1.72, -0.86, 10100, 0},
    {"50V", 0, -0.86, 5100, 0},      {"25L", -9, -1.72, 1700, 0},
    {"25R", 9, -1.72, 1700, 0},      {"point 7", -8, 0, 65, 0},
    {"point 8", -4, 0, 125, 0},
};

TEST(LowBeam, KeepsRegulation112AtItsTestPoints) {
  const Beam beam(Side::right);
  for (const TestPoint& p : points) {
    const double candela = beam.at(p.h, p.v);
    if (p.least > 0) {
      EXPECT_GE(candela, p.least) << p.name;
    }
    if (p.greatest > 0) {
      EXPECT_LE(candela, p.greatest) << p.name;
    }
  }
  EXPECT_GE(beam.at(-8, 4) + beam.at(0, 4) + beam.at(8, 4), 190) << "points 1 + 2 + 3";
  EXPECT_GE(beam.at(-4, 2) + beam.at(0, 2) + beam.at(4, 2), 375) << "points 4 + 5 + 6";
}

/// Returns whether (h, v) lies in zone III: above a line through these corners,
/// within 8 degrees and below
/// 4.
bool in_zone_three(double h, double v) {
  constexpr double line[][2] = {{-8, 1}, {-4, 0}, {0, 0}, {1.5, 1.5}, {6, 1.5}, {8, 2}};
  if (h < -8 || h > 8 || v > 4) return false;
  for (std::size_t n = 0; n + 1 < std::size(line); ++n)
    if (h >= line[n][0] && h <= line[n + 1][0])
      return v >= line[n][1] + (line[n + 1][1] - line[n][1]) * (h - line[n][0]) /
                                   (line[n + 1][0] - line[n][0]);
  return false;
}

TEST(LowBeam, KeepsRegulation112InItsZones) {
  const Beam beam(Side::right);
  for (double h = -8; h <= 8; h += 0.1)
    for (double v = -0.2; v <= 4; v += 0.05)
      if (in_zone_three(h, v)) {
        EXPECT_LE(beam.at(h, v), 625) << "zone III at " << h << ", " << v;
      }
  for (double h = -5.15; h <= 5.15; h += 0.1)
    for (double v = -1.72; v <= -0.86; v += 0.02)
      EXPECT_GE(beam.at(h, v), 2500) << "zone IV at " << h << ", " << v;
  const double most = 2 * beam.at(1.72, -0.86);
  for (double h = -9; h <= 9; h += 0.2)
    for (double v = -4; v <= -1.72; v += 0.05)
      EXPECT_LE(beam.at(h, v), most) << "zone I at " << h << ", " << v;
}

TEST(LowBeam, IsMirroredWhereOneDrivesOnTheLeft) {
  const Beam right(Side::right), left(Side::left);
  for (double h = -12; h <= 12; h += 0.37)
    for (double v = -5; v <= 2; v += 0.13)
      EXPECT_NEAR(left.at(-h, v), right.at(h, v), 1e-3 * right.at(h, v) + 0.5) << h << ", " << v;
}

TEST(LowBeam, CutOffAndKinkAreHeldByTheGrid) {
  const Beam beam(Side::right);
  // The cut-off is where the intensity falls to half of what it is half a degree lower. Check it
  // all the way across.
  for (double h = -10; h <= 6; h += 0.25) {
    const double expected = h <= 0 ? -0.57 : std::min(-0.57 + std::tan(15 * pi / 180) * h, 1.2);
    const double half = beam.at(h, expected - 0.5) / 2;
    double v = expected - 0.5;
    while (v < expected + 0.5 && beam.at(h, v) > half) v += 0.01;
    EXPECT_NEAR(v, expected, 0.12) << "at " << h;
  }
}

TEST(LowBeam, FluxIsTheProfilesIntegral) {
  EXPECT_NEAR(lights::integrated_flux(low_beam(Side::left)), low_beam_flux_lm(),
              0.005 * low_beam_flux_lm());
  // The flux of a halogen headlamp on the road: makers' notes give 400 to 1000 lm.
  EXPECT_GT(low_beam_flux_lm(), 350);
  EXPECT_LT(low_beam_flux_lm(), 1000);
}

TEST(SignalLamps, ShineAsRegulation7Asks) {
  lights::ProfileTable profiles;
  const VehicleLamps lamps = make_vehicle_lamps(Side::right, profiles);
  const lights::Photometry beam = signal_beam();
  const double flux = lights::integrated_flux(beam), peak = lights::intensity_at(beam, 0, 0);
  for (const Light& light : lamps.lights) {
    if (light.id != static_cast<uint>(LightFamily::tail_lamp)) continue;
    const double candela = double{light.flux_lm} * peak / flux;
    if (light.schedule == VEHICLE_LIGHT_ALWAYS) {
      EXPECT_GE(candela, 4);
      EXPECT_LE(candela, 17);
    } else {
      EXPECT_GE(candela, 60);
      EXPECT_LE(candela, 260);
    }
    // Field of visibility: ten per cent at 20 degrees to the side, and some light at 80 degrees.
    EXPECT_GE(lights::intensity_at(beam, 0, 20 * pi / 180) / peak, 0.1);
    EXPECT_GE(candela * lights::intensity_at(beam, 0, 45 * pi / 180) / peak, 0.05);
    EXPECT_LT(light.axis.x, 0);
    const glm::vec3 colour = decode_rgb9e5(light.colour_rgb9e5);
    EXPECT_GT(colour.x, 4 * colour.y);
  }
}

TEST(VehicleLamps, EveryTypeIsFitForAFileAndCarriesWhatTheLawAsks) {
  lights::ProfileTable profiles;
  const VehicleLamps lamps = make_vehicle_lamps(Side::right, profiles);
  ASSERT_EQ(lamps.kinds.size(), vehicle_type_count);
  for (std::size_t k = 0; k < vehicle_type_count; ++k) {
    const VehicleKind& kind = lamps.kinds[k];
    EXPECT_FALSE(vehicle_fault(kind, lamps.lights.size())) << vehicle_types[k].name;
    std::multiset<std::string> families;
    for (uint n = 0; n < kind.light_count; ++n) {
      const Light& light = lamps.lights[kind.first_light + n];
      EXPECT_FALSE(vehicle_light_fault(light, profiles.profiles.size())) << vehicle_types[k].name;
      const bool head = light.id == static_cast<uint>(LightFamily::headlamp);
      families.insert(head ? "head" : light.schedule == VEHICLE_LIGHT_BRAKING ? "brake" : "tail");
      // Outside the body, which would block it otherwise, and at the heights of UN Regulation 48.
      EXPECT_GT(std::abs(light.position.x), kind.half_size.x + light.radius);
      EXPECT_LT(std::abs(light.position.z), kind.half_size.z);
      EXPECT_GE(light.position.y, head ? 0.5f : 0.35f);
      EXPECT_LE(light.position.y, head ? 1.2f : 1.5f);
    }
    const std::size_t each = vehicle_types[k].shape == Shape::motorcycle ? 1 : 2;
    EXPECT_EQ(families.count("head"), each);
    EXPECT_EQ(families.count("tail"), each);
    EXPECT_EQ(families.count("brake"), each);
  }
}

}  // namespace
}  // namespace nightcity::traffic
