#include "runtime/scene/skyglow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "formats/parallel.h"
#include "runtime/scene/lit_lights.h"

namespace nightcity::scene {
namespace {

using std::numbers::pi;

constexpr double per_km = 1e-3;
// Molecules per cm^3 at sea level times their cross section for green light, 2.55e19 * 4.6e-27 / cm
// (Garstang 1989).
constexpr double molecules = 0.01173 * per_km;
constexpr double molecules_falloff = 0.104 * per_km;  // with height, 1/m
constexpr double top_m = 60'000;
constexpr double farthest_m = 200'000;

double aerosols(const Atmosphere& air) {
  return 11.11 * air.clarity * molecules;
}
double aerosols_falloff(const Atmosphere& air) {
  return (0.657 + 0.059 * air.clarity) * per_km;
}

// Extinction of the channels of Rec. 709 as multiples of that of green light of 550 nm: molecules
// scatter by the wavelength to the power of -4, aerosols by -1.3, at the primaries' dominant
// wavelengths, 611, 549 and 464 nm.
const glm::dvec3 molecules_by_channel{0.657, 1.007, 1.974};
const glm::dvec3 aerosols_by_channel{0.872, 1.002, 1.247};

// Returns the integral of exp(-falloff * height) over a way between two heights.
double integrate_falloff(double falloff, double from_m, double to_m, double length) {
  const double x = falloff * (to_m - from_m);
  const double mean = std::abs(x) < 1e-6 ? 1 - x / 2 : -std::expm1(-x) / x;
  return length * std::exp(-falloff * from_m) * mean;
}

glm::dvec3 depth_between(const Atmosphere& air, double from_m, double to_m, double length) {
  return molecules_by_channel * molecules *
             integrate_falloff(molecules_falloff, from_m, to_m, length) +
         aerosols_by_channel * aerosols(air) *
             integrate_falloff(aerosols_falloff(air), from_m, to_m, length);
}

double rayleigh_phase(double cosine) {
  return 3 / (16 * pi) * (1 + cosine * cosine);
}

// The upper ends of the bands of elevation, as sines.
const std::array<double, CityGlow::bands> band_ends = [] {
  std::array<double, CityGlow::bands> ends{};
  for (std::size_t band = 0; band < CityGlow::bands; ++band)
    ends[band] = std::sin(double(band + 1) * 5 * pi / 180);
  return ends;
}();

// Returns the intensity of a source towards an elevation, cd: even in all azimuths and within a
// band.
double intensity_at(const CityGlow& glow, const CityGlow::Source& source, double sine) {
  const auto end = std::lower_bound(band_ends.begin(), band_ends.end() - 1, sine);
  const auto band = static_cast<std::size_t>(end - band_ends.begin());
  const double below = band == 0 ? 0 : band_ends[band - 1];
  return source.flux_lm * glow.band_share[band] / (2 * pi * (*end - below));
}

// The aerosols' phase function by the cosine of the angle, which is dense near forward scattering.
double aerosol_phase_of_cosine(double cosine) {
  constexpr std::size_t entries = 1024;
  static const std::vector<double> table = [] {
    std::vector<double> values(entries + 1);
    for (std::size_t i = 0; i <= entries; ++i) {
      const double root =
          double(i) / entries;  // sqrt((1 - cosine) / 2): the sine of half the angle
      values[i] = aerosol_phase(2 * std::asin(root) * 180 / pi);
    }
    return values;
  }();
  const double at = std::sqrt(std::clamp((1 - cosine) / 2, 0.0, 1.0)) * entries;
  const auto low = std::min(static_cast<std::size_t>(at), entries - 1);
  return table[low] + (at - double(low)) * (table[low + 1] - table[low]);
}

// Calls visit(direction from the source, illuminance of a facing surface) for the light of each
// source at a place above the ground, lux per channel.
template <class Visit>
void visit_light_at(const CityGlow& glow, const Atmosphere& air, const glm::dvec3& place,
                    Visit visit) {
  for (const CityGlow::Source& source : glow.sources) {
    const glm::dvec3 way(place.x - source.place.x, place.y, place.z - source.place.y);
    // A square is as far as its parts are in the mean.
    const double square = glm::dot(way, way) + source.radius_m * source.radius_m / 2;
    const double length = std::sqrt(square);
    const double candela = intensity_at(glow, source, std::min(1.0, place.y / length));
    if (!(candela > 0)) continue;
    const glm::dvec3 passed = glm::exp(-depth_between(air, 0, place.y, length));
    visit(way / std::max(glm::length(way), 1e-9), glow.colour * passed * (candela / square));
  }
}

// Returns the light that a metre of air at a place scatters into a direction, cd/m^2 per channel.
glm::dvec3 scattered_at(const CityGlow& glow, const Atmosphere& air, const glm::dvec3& place,
                        const glm::dvec3& to_eye) {
  const double few = molecules * std::exp(-molecules_falloff * place.y),
               many = aerosols(air) * std::exp(-aerosols_falloff(air) * place.y);
  glm::dvec3 sum(0);
  visit_light_at(glow, air, place, [&](const glm::dvec3& way, const glm::dvec3& lux) {
    const double cosine = std::clamp(glm::dot(way, to_eye), -1.0, 1.0);
    sum += lux * (molecules_by_channel * (few * rayleigh_phase(cosine)) +
                  aerosols_by_channel * (many * aerosol_phase_of_cosine(cosine)));
  });
  return sum;
}

glm::dvec3 illuminance_of_clouds(const CityGlow& glow, const Atmosphere& air,
                                 const glm::dvec3& place) {
  glm::dvec3 sum(0);
  visit_light_at(glow, air, place,
                 [&](const glm::dvec3& way, const glm::dvec3& lux) { sum += lux * way.y; });
  return sum;
}

constexpr double darkest = 1e-12;   // cd/m^2: its logarithm is finite
constexpr double brightest = 1e30;  // floats hold it, and what surfaces make of it
constexpr double lowest = 0.25 * pi / 180;

// Rows of directions, 0 at the horizon .. 1 at the zenith.
double elevation_of(double share) {
  return lowest + (pi / 2 - lowest) * share * share;
}
double row_share_of(double elevation) {
  return std::sqrt(std::max(0.0, elevation - lowest) / (pi / 2 - lowest));
}

}  // namespace

double extinction_at(const Atmosphere& air, double height_m) {
  return molecules * std::exp(-molecules_falloff * height_m) +
         aerosols(air) * std::exp(-aerosols_falloff(air) * height_m);
}

double zenith_depth(const Atmosphere& air) {
  return molecules / molecules_falloff + aerosols(air) / aerosols_falloff(air);
}

double aerosol_phase(double angle_deg) {
  const double a = angle_deg, square = a * a;
  if (a <= 10) return 7.5 * std::exp(-0.1249 * square / (1 + 0.04996 * square));
  if (a <= 124) return 1.88 * std::exp(-0.07226 * a + 0.0002406 * square);
  return 0.025 + 0.015 * std::sin((2.25 * a - 369) * pi / 180);
}

glm::dvec3 sky_luminance(const CityGlow& glow, const Atmosphere& air, const glm::dvec2& place,
                         const glm::dvec3& direction) {
  constexpr int steps = 32;
  const double top = air.overcast ? air.cloud_base_m : top_m;
  const double end = std::min(top / std::max(direction.y, 1e-6), farthest_m);
  const glm::dvec3 eye(place.x, 0, place.y);
  // Steps grow with the distance, as the air that is lit thins out.
  constexpr double first_m = 20;
  const double growth = std::log(1 + end / first_m) / steps;
  const auto distance_at = [&](double step) { return first_m * std::expm1(growth * step); };
  glm::dvec3 sum(0);
  for (int i = 0; i < steps; ++i) {
    const double at = distance_at(i + 0.5), length = distance_at(i + 1) - distance_at(i);
    const glm::dvec3 point = eye + direction * at;
    sum += scattered_at(glow, air, point, -direction) *
           glm::exp(-depth_between(air, 0, point.y, at)) * length;
  }
  if (!air.overcast) return sum + natural_sky_cd_m2;
  const glm::dvec3 cloud = eye + direction * end;
  return sum + illuminance_of_clouds(glow, air, cloud) * (air.cloud_reflectance / pi) *
                   glm::exp(-depth_between(air, 0, cloud.y, end));
}

SkyMap make_skyglow(const CityGlow& glow, const Atmosphere& air, const Box& bounds) {
  glm::dvec2 middle(0);
  if (!bounds.empty())
    middle = {(double(bounds.lower.x) + double(bounds.upper.x)) / 2,
              (double(bounds.lower.z) + double(bounds.upper.z)) / 2};
  // The sky is computed in few directions, more of them near the horizon, and interpolated.
  constexpr unsigned turns = 24, rows = 14;
  std::vector<glm::dvec3> logarithms(std::size_t{rows} * turns);
  run_parallel(rows, count_cores(), [&](std::size_t row) {
    const double elevation = elevation_of(double(row) / (rows - 1));
    for (unsigned turn = 0; turn < turns; ++turn) {
      const double azimuth = 2 * pi * turn / turns;  // from north over east
      const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                 -std::cos(elevation) * std::cos(azimuth));
      logarithms[row * turns + turn] =
          glm::log(sky_luminance(glow, air, middle, direction) + darkest);
    }
  });
  SkyMap map{256, 256, {}};
  map.natural_cd_m2 = air.overcast ? 0 : float(natural_sky_cd_m2);
  map.rgb.assign(std::size_t{3} * map.width * map.height, 0);
  for (std::uint32_t y = 0; y < map.height / 2; ++y)
    for (std::uint32_t x = 0; x < map.width; ++x) {
      const double elevation = pi / 2 - (y + 0.5) * pi / map.height;
      const double row = std::min(row_share_of(elevation) * (rows - 1), rows - 1.000001);
      const double turn = std::fmod((x + 0.5) / map.width + 0.5, 1.0) * turns;
      const auto low = static_cast<std::size_t>(row), left = static_cast<std::size_t>(turn);
      const auto at = [&](std::size_t r, std::size_t t) {
        return logarithms[r * turns + t % turns];
      };
      const glm::dvec3 below = glm::mix(at(low, left), at(low, left + 1), turn - double(left)),
                       above =
                           glm::mix(at(low + 1, left), at(low + 1, left + 1), turn - double(left));
      const glm::dvec3 luminance =
          glm::clamp(glm::exp(glm::mix(below, above, row - double(low))) - darkest, 0.0, brightest);
      for (int c = 0; c < 3; ++c)
        map.rgb[3 * (std::size_t{y} * map.width + x) + std::size_t(c)] = float(luminance[c]);
    }
  return map;
}

CitySky make_city_sky(const RenderScene& scene, double time_s, LightFamilies on,
                      const Atmosphere& air, double radius_m) {
  std::vector<float> all(scene.lights.size());
  std::transform(scene.lights.begin(), scene.lights.end(), all.begin(),
                 [](const Light& light) { return light.flux_lm; });
  const std::vector<float> now =
      flux_of(lit_lights(scene.lights, scene.families, scene.schedules, scene.switches, time_s, on),
              scene.lights);
  // Half of the paths are of the lights that shine, however strong others are, and half of all
  // lights, so that the sky can follow them.
  const auto sum_of = [](const std::vector<float>& flux) {
    return std::max(std::accumulate(flux.begin(), flux.end(), 0.0), 1e-300);
  };
  const double sum_now = sum_of(now), sum_all = sum_of(all);
  std::vector<double> weight(all.size());
  for (std::size_t i = 0; i < weight.size(); ++i)
    weight[i] = double{now[i]} / sum_now + double{all[i]} / sum_all;
  const std::vector<UpwardPath> paths = follow_upward_light(scene, std::move(weight), 32768);

  CitySky sky{find_city_glow(paths, now, scene.bounds), {}};
  CityGlow glow = find_city_glow(paths, all, scene.bounds);
  if (sky.glow.flux_lm() > 0.01 * glow.flux_lm()) glow = sky.glow;
  const glm::dvec3 upward_lm = glow.flux_lm() * glow.colour;
  extend_city(glow, scene.bounds, radius_m);
  sky.map = make_skyglow(glow, air, scene.bounds);
  sky.map.upward_lm = upward_lm;
  std::map<std::uint32_t, glm::dvec3> shares;
  for (const UpwardPath& path : paths) shares[path.light] += path.share;
  for (const auto& [light, share] : shares) sky.map.shares.push_back({light, glm::vec3(share)});
  return sky;
}

}  // namespace nightcity::scene
