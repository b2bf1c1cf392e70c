#include "runtime/scene/city_glow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "formats/parallel.h"
#include "formats/rgb9e5.h"
#include "runtime/scene/lit_lights.h"
#include "runtime/scene/point_light.h"
#include "runtime/scene/trace_ray.h"
#include "shaders/limits.h"

namespace nightcity::scene {
namespace {

using std::numbers::pi;

constexpr unsigned max_bounces = 4;
constexpr std::uint32_t paths_of_a_job = 256;
constexpr std::uint32_t squares = 6;  // along each side of the scene

struct Escape {
  glm::dvec3 from, direction;
  glm::dvec3 flux;  // lm per channel
  bool direct;
};

class Paths {
 public:
  Paths(const RenderScene& scene, std::vector<double> cumulative, std::uint32_t count)
      : scene_(scene), cumulative_(std::move(cumulative)), count_(count) {}

  // Follows the paths [first, last).
  std::vector<Escape> follow(std::uint32_t first, std::uint32_t last) const {
    std::mt19937 random(first);
    std::vector<Escape> escapes;
    for (std::uint32_t i = first; i < last; ++i) follow_one(i, random, escapes);
    return escapes;
  }

 private:
  static double uniform(std::mt19937& random) { return double(random()) / 4294967296.0; }

  static glm::dvec3 cosine_direction(const glm::dvec3& normal, std::mt19937& random) {
    const double z = 2 * uniform(random) - 1, phi = 2 * pi * uniform(random);
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const glm::dvec3 sum = normal + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
    const double length = glm::length(sum);
    return length > 1e-9 ? sum / length : normal;
  }

  void follow_one(std::uint32_t index, std::mt19937& random, std::vector<Escape>& escapes) const {
    const double all = cumulative_.back();
    const double at = (index + uniform(random)) / count_ * all;
    const auto chosen = static_cast<std::size_t>(
        std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, at) - cumulative_.begin());
    const Light& light = scene_.lights[chosen];
    glm::dvec3 origin(light.position), direction;
    glm::dvec3 flux = glm::dvec3(decode_rgb9e5(light.colour_rgb9e5)) * (all / count_);
    if (light_kind(light) == LightKind::rectangle) {
      const glm::dvec3 axis(light.axis), right(light.tangent);
      const double across = 2 * uniform(random) - 1, along = 2 * uniform(random) - 1;
      origin += across * double(half_width(light)) * right +
                along * double(light.half_height) * glm::cross(axis, right) +
                clearance_at(origin) * axis;
      direction = cosine_direction(axis, random);
    } else {
      const double z = 2 * uniform(random) - 1, phi = 2 * pi * uniform(random);
      const double r = std::sqrt(std::max(0.0, 1 - z * z));
      direction = {r * std::cos(phi), r * std::sin(phi), z};
      flux *= 4 * pi * intensity_per_lumen(scene_, light, direction);
    }
    for (unsigned bounce = 0; bounce <= max_bounces; ++bounce) {
      if (!(std::max({flux.r, flux.g, flux.b}) > 0)) return;
      const auto hit = trace_ray(scene_, origin, direction, 1e30, MASK_SHADOW);
      if (!hit) {
        if (direction.y > 0) escapes.push_back({origin, direction, flux, bounce == 0});
        return;
      }
      const std::uint32_t material = scene_.triangles[hit->triangle].material;
      flux *= glm::dvec3(scene_.materials[material].base_colour);
      origin += hit->distance * direction;
      origin += clearance_at(origin) * hit->normal;
      direction = cosine_direction(hit->normal, random);
    }
  }

  // A ray that starts on a surface must not hit it.
  static double clearance_at(const glm::dvec3& place) {
    return 1e-4 + 1e-6 * std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
  }

  const RenderScene& scene_;
  std::vector<double> cumulative_;  // flux of the lights up to each, lm
  std::uint32_t count_;
};

double luminance(const glm::dvec3& rgb) {
  return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

void add_to_squares(const std::vector<Escape>& escapes, const Box& bounds, CityGlow& glow) {
  const glm::dvec2 lower(bounds.lower.x, bounds.lower.z), upper(bounds.upper.x, bounds.upper.z);
  const glm::dvec2 side = glm::max((upper - lower) / double(squares), glm::dvec2(1));
  std::vector<double> flux(std::size_t{squares} * squares);
  for (const Escape& escape : escapes) {
    const glm::dvec2 at = (glm::dvec2(escape.from.x, escape.from.z) - lower) / side;
    const auto cell = [](double x) {
      return static_cast<std::size_t>(std::clamp(x, 0.0, double(squares - 1)));
    };
    flux[cell(at.y) * squares + cell(at.x)] += luminance(escape.flux);
  }
  for (std::size_t i = 0; i < flux.size(); ++i)
    if (flux[i] > 0)
      glow.sources.push_back(
          {lower + (glm::dvec2(double(i % squares), double(i / squares)) + 0.5) * side,
           std::sqrt(side.x * side.y / pi), flux[i]});
}

}  // namespace

CityGlow find_city_glow(const RenderScene& scene, double time_s, LightFamilies on,
                        std::uint32_t paths) {
  CityGlow glow;
  const std::vector<float> flux =
      flux_of(lit_lights(scene.lights, scene.families, scene.schedules, scene.switches, time_s, on),
              scene.lights);
  std::vector<double> cumulative(flux.size());
  std::partial_sum(flux.begin(), flux.end(), cumulative.begin(),
                   [](double sum, float next) { return sum + double{next}; });
  if (cumulative.empty() || !(cumulative.back() > 0) || scene.bounds.empty()) return glow;
  glow.lamp_flux_lm = cumulative.back();
  const Paths all(scene, std::move(cumulative), paths);
  const std::uint32_t jobs = (paths + paths_of_a_job - 1) / paths_of_a_job;
  std::vector<std::vector<Escape>> found(jobs);
  run_parallel(jobs, count_cores(), [&](std::size_t job) {
    const auto first = static_cast<std::uint32_t>(job) * paths_of_a_job;
    found[job] = all.follow(first, std::min(first + paths_of_a_job, paths));
  });
  std::vector<Escape> escapes;
  for (const auto& part : found) escapes.insert(escapes.end(), part.begin(), part.end());
  glm::dvec3 sum(0);
  for (const Escape& escape : escapes) {
    const double lumen = luminance(escape.flux);
    (escape.direct ? glow.direct_lm : glow.reflected_lm) += lumen;
    sum += escape.flux;
    const double degrees = std::asin(std::min(1.0, escape.direction.y)) * 180 / pi;
    glow.band_share[std::min<std::size_t>(std::size_t(degrees / 5), CityGlow::bands - 1)] += lumen;
  }
  if (!(glow.flux_lm() > 0)) return glow;
  for (double& share : glow.band_share) share /= glow.flux_lm();
  glow.colour = sum / luminance(sum);
  add_to_squares(escapes, scene.bounds, glow);
  return glow;
}

void extend_city(CityGlow& glow, const Box& bounds, double radius_m) {
  const double width = double(bounds.upper.x) - double(bounds.lower.x),
               depth = double(bounds.upper.z) - double(bounds.lower.z);
  const double area = width * depth, inner = std::sqrt(std::max(area, 1.0) / pi);
  if (!(radius_m > inner) || glow.sources.empty()) return;
  const glm::dvec2 middle(double(bounds.lower.x) + width / 2, double(bounds.lower.z) + depth / 2);
  const double density = glow.flux_lm() / std::max(area, 1.0);
  constexpr int rings = 6, turns = 8;
  double from = inner;
  for (int ring = 1; ring <= rings; ++ring) {
    const double to = inner * std::pow(radius_m / inner, double(ring) / rings);
    const double piece = pi * (to * to - from * from) / turns;
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = 2 * pi * (turn + 0.5 * (ring % 2)) / turns, at = (from + to) / 2;
      glow.sources.push_back({middle + at * glm::dvec2(std::cos(angle), std::sin(angle)),
                              std::sqrt(piece / pi), density * piece});
    }
    from = to;
  }
}

}  // namespace nightcity::scene
