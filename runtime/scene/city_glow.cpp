#include "runtime/scene/city_glow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "formats/parallel.h"
#include "formats/rgb9e5.h"
#include "runtime/scene/point_light.h"
#include "runtime/scene/trace_ray.h"
#include "shaders/limits.h"

namespace nightcity::scene {
namespace {

using std::numbers::pi;

constexpr unsigned max_bounces = 4;
constexpr std::uint32_t paths_of_a_job = 256;
constexpr std::uint32_t squares = 6;  // along each side of the scene

class Paths {
 public:
  Paths(const RenderScene& scene, std::vector<double> weight, std::uint32_t count)
      : scene_(scene), weight_(std::move(weight)), cumulative_(weight_.size()), count_(count) {
    std::partial_sum(weight_.begin(), weight_.end(), cumulative_.begin());
  }

  bool empty() const { return cumulative_.empty() || !(cumulative_.back() > 0); }

  // Follows the paths [first, last).
  std::vector<UpwardPath> follow(std::uint32_t first, std::uint32_t last) const {
    std::mt19937 random(first);
    std::vector<UpwardPath> escapes;
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

  void follow_one(std::uint32_t index, std::mt19937& random,
                  std::vector<UpwardPath>& escapes) const {
    const double all = cumulative_.back();
    const double at = (index + uniform(random)) / count_ * all;
    const auto chosen = static_cast<std::size_t>(
        std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, at) - cumulative_.begin());
    const Light& light = scene_.lights[chosen];
    glm::dvec3 origin(light.position), direction;
    glm::dvec3 share =
        glm::dvec3(decode_rgb9e5(light.colour_rgb9e5)) * (all / count_ / weight_[chosen]);
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
      share *= 4 * pi * intensity_per_lumen(scene_, light, direction);
    }
    for (unsigned bounce = 0; bounce <= max_bounces; ++bounce) {
      if (!(std::max({share.r, share.g, share.b}) > 0)) return;
      const auto hit = trace_ray(scene_, origin, direction, 1e30, MASK_SHADOW);
      if (!hit) {
        if (direction.y > 0)
          escapes.push_back(
              {static_cast<std::uint32_t>(chosen), bounce == 0, origin, direction, share});
        return;
      }
      const std::uint32_t material = scene_.triangles[hit->triangle].material;
      share *= glm::dvec3(scene_.materials[material].base_colour);
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
  std::vector<double> weight_, cumulative_;  // of each light, and of those up to it
  std::uint32_t count_;
};

double luminance(const glm::dvec3& rgb) {
  return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

// The flux that leaves each square of a scene upwards, lm.
class Squares {
 public:
  explicit Squares(const Box& bounds)
      : lower_(bounds.lower.x, bounds.lower.z),
        side_(glm::max((glm::dvec2(bounds.upper.x, bounds.upper.z) - lower_) / double(squares),
                       glm::dvec2(1))) {}

  void add(const glm::dvec3& from, double lumen) {
    const glm::dvec2 at = (glm::dvec2(from.x, from.z) - lower_) / side_;
    const auto cell = [](double x) {
      return static_cast<std::size_t>(std::clamp(x, 0.0, double(squares - 1)));
    };
    flux_[cell(at.y) * squares + cell(at.x)] += lumen;
  }

  std::vector<CityGlow::Source> sources() const {
    std::vector<CityGlow::Source> sources;
    for (std::size_t i = 0; i < flux_.size(); ++i)
      if (flux_[i] > 0)
        sources.push_back(
            {lower_ + (glm::dvec2(double(i % squares), double(i / squares)) + 0.5) * side_,
             std::sqrt(side_.x * side_.y / pi), flux_[i]});
    return sources;
  }

 private:
  glm::dvec2 lower_, side_;
  std::vector<double> flux_ = std::vector<double>(std::size_t{squares} * squares);
};

}  // namespace

std::vector<UpwardPath> follow_upward_light(const RenderScene& scene, std::vector<double> weight,
                                            std::uint32_t paths) {
  const Paths all(scene, std::move(weight), paths);
  if (all.empty() || scene.bounds.empty()) return {};
  const std::uint32_t jobs = (paths + paths_of_a_job - 1) / paths_of_a_job;
  std::vector<std::vector<UpwardPath>> found(jobs);
  run_parallel(jobs, count_cores(), [&](std::size_t job) {
    const auto first = static_cast<std::uint32_t>(job) * paths_of_a_job;
    found[job] = all.follow(first, std::min(first + paths_of_a_job, paths));
  });
  std::vector<UpwardPath> escapes;
  for (const auto& part : found) escapes.insert(escapes.end(), part.begin(), part.end());
  return escapes;
}

CityGlow find_city_glow(std::span<const UpwardPath> paths, std::span<const float> flux_lm,
                        const Box& bounds) {
  CityGlow glow;
  glow.lamp_flux_lm = std::accumulate(flux_lm.begin(), flux_lm.end(), 0.0);
  if (bounds.empty()) return glow;
  Squares squares(bounds);
  glm::dvec3 sum(0);
  for (const UpwardPath& path : paths) {
    const glm::dvec3 flux = path.share * double{flux_lm[path.light]};
    const double lumen = luminance(flux);
    (path.direct ? glow.direct_lm : glow.reflected_lm) += lumen;
    sum += flux;
    const double degrees = std::asin(std::min(1.0, path.direction.y)) * 180 / pi;
    glow.band_share[std::min<std::size_t>(std::size_t(degrees / 5), CityGlow::bands - 1)] += lumen;
    squares.add(path.from, lumen);
  }
  if (!(glow.flux_lm() > 0)) return glow;
  for (double& share : glow.band_share) share /= glow.flux_lm();
  glow.colour = sum / luminance(sum);
  glow.sources = squares.sources();
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
