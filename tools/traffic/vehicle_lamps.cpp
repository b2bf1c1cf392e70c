#include "tools/traffic/vehicle_lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/rgb9e5.h"
#include "formats/colour.h"

namespace nightcity::traffic {
namespace {

using std::numbers::pi;

constexpr double beam_extent_degrees = 40;
constexpr std::uint32_t beam_planes = 720, beam_rows = 321;  // half a degree, an eighth of a degree

constexpr double cut_off_degrees = -0.57;  // 1 % down
constexpr double kink_slope = 0.26794919;  // tan 15 degrees
constexpr double kink_top_degrees = 1.2;   // below the 1.5 degrees where zone III begins again

double bell(double x) {
  return std::exp(-x * x);
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A peak that falls to half at 12 degrees, and some light to all sides, for the field of 45 to 80
/// degrees that Regulation 7 asks for.
double signal(double gamma) {
  const double cosine = std::cos(gamma);
  return cosine > 0 ? 0.92 * std::pow(cosine, 31) + 0.08 * cosine : 0;
}

Light lamp(const glm::vec3& place, const glm::vec3& axis, double radius, double flux,
           const glm::vec3& colour, std::uint32_t profile, uint condition, LightFamily family) {
  Light light{};
  light.position = place;
  light.radius = static_cast<float>(radius);
  light.axis = axis;
  light.tangent = {0, 0, 1};
  light.flux_lm = static_cast<float>(flux);
  light.colour_rgb9e5 = encode_rgb9e5(colour);
  light.kind_profile = pack_kind_profile(LightKind::sphere, profile);
  light.schedule = condition;
  light.id = static_cast<uint>(family);
  return light;
}

}  // namespace

double low_beam_cd(double h, double v) {
  const double cut =
      h <= 0 ? cut_off_degrees : std::min(cut_off_degrees + kink_slope * h, kink_top_degrees);
  const double below = cut - v;  // degrees under the cut-off
  // Real cut-offs change from dark to bright within a few tenths of a degree.
  const double under = 1 / (1 + std::exp(-std::clamp(below / 0.09, -40.0, 40.0)));
  const double depth = std::max(below, 0.0);
  const double hot = 17500 * bell((h - 1.3) / 4.6) * std::exp(-depth / 1.3);
  const double wide = 5200 * bell(h / 24) * std::exp(-depth / 6.5);
  const double aside = 1 - smooth(18, 36, std::abs(h)), high = 1 - smooth(3, 14, v),
               low = 1 - smooth(6, 20, -v);
  const double glow = 160 * bell(h / 22) * high * low;
  const double edge = 1 - smooth(28, beam_extent_degrees - 0.5, std::hypot(h, v));
  return ((hot + wide) * under * (0.3 + 0.7 * aside) + glow) * edge;
}

lights::Photometry low_beam(Side side) {
  return lights::sample_intensity(
      [side](double c, double gamma) {
        // C = 0 right, 90 degrees down.
        const double right = std::sin(gamma) * std::cos(c), up = -std::sin(gamma) * std::sin(c);
        const double h = std::atan2(right, std::cos(gamma)) * 180 / pi,
                     v = std::asin(up) * 180 / pi;
        return low_beam_cd(side == Side::right ? h : -h, v);
      },
      beam_planes, beam_rows, beam_extent_degrees);
}

double low_beam_flux_lm() {
  static const double flux = lights::integrated_flux(low_beam(Side::right));
  return flux;
}

lights::Photometry signal_beam() {
  return lights::sample_intensity([](double, double gamma) { return signal(gamma); }, 1, 91, 90);
}

VehicleLamps make_vehicle_lamps(Side side, lights::ProfileTable& profiles) {
  const std::uint32_t beam =
      profiles.add(side == Side::right ? "low beam, right" : "low beam, left", low_beam(side));
  const std::uint32_t signal_profile = profiles.add("vehicle signal", signal_beam());
  const double per_candela = lights::integrated_flux(signal_beam());
  // Signal red: dominant wavelength 620 nm, on the spectral locus.
  const glm::vec3 red = rec709_from_xy({0.6915, 0.3083});
  VehicleLamps result;
  for (const VehicleType& type : vehicle_types) {
    VehicleKind kind{};
    kind.half_size = {static_cast<float>(type.length_m / 2), static_cast<float>(type.height_m / 2),
                      static_cast<float>(type.width_m / 2)};
    kind.first_light = static_cast<uint>(result.lights.size());
    const auto pairs = [&](double apart) {
      return apart > 0 ? std::vector<double>{-apart / 2, apart / 2} : std::vector<double>{0};
    };
    const glm::vec3 white = rec709_from_xy(planckian_xy(type.headlamp_cct_k));
    const double front = type.length_m / 2 + headlamp_radius_m + 0.01,
                 rear = type.length_m / 2 + signal_radius_m + 0.01;
    for (const double z : pairs(type.headlamp_apart_m))
      result.lights.push_back(lamp({front, type.headlamp_height_m, z}, {1, 0, 0}, headlamp_radius_m,
                                   low_beam_flux_lm(), white, beam, VEHICLE_LIGHT_ALWAYS,
                                   LightFamily::headlamp));
    const bool single = type.headlamp_apart_m == 0;
    const double tails = single ? 0 : type.width_m - 0.4;
    for (const double z : pairs(tails))
      result.lights.push_back(lamp({-rear, type.tail_lamp_height_m, z}, {-1, 0, 0}, signal_radius_m,
                                   tail_lamp_cd * per_candela, red, signal_profile,
                                   VEHICLE_LIGHT_ALWAYS, LightFamily::tail_lamp));
    for (const double z : pairs(tails))
      result.lights.push_back(lamp({-rear, type.tail_lamp_height_m - 0.1, z}, {-1, 0, 0},
                                   signal_radius_m, brake_lamp_cd * per_candela, red,
                                   signal_profile, VEHICLE_LIGHT_BRAKING, LightFamily::tail_lamp));
    kind.light_count = static_cast<uint>(result.lights.size()) - kind.first_light;
    result.kinds.push_back(kind);
  }
  return result;
}

}  // namespace nightcity::traffic
