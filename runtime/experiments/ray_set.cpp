#include "runtime/experiments/ray_set.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "formats/parallel.h"
#include "runtime/scene/trace_ray.h"

namespace nightcity::experiments {
namespace {

constexpr std::uint32_t square = 8;      // pixels a side
constexpr std::size_t at_once = 1024;    // rays of one task
constexpr int candidates = 24;           // lights
constexpr double clearance_m = 1e-2;     // of shadow rays off their surface
constexpr double short_of_light = 1e-3;  // share of the way at which they end before it

// Chooses lights by flux.
class LightDraw {
 public:
  explicit LightDraw(const scene::RenderScene& scene) : scene_(scene) {
    double sum = 0;
    for (const Light& light : scene.lights) sums_.push_back(sum += double(light.flux_lm));
  }
  bool has_any() const { return !sums_.empty() && sums_.back() > 0; }

  std::optional<glm::dvec3> choose(const glm::dvec3& from, const glm::dvec3& normal,
                                   std::mt19937& random) const {
    std::uniform_real_distribution<double> unit(0, 1);
    std::optional<glm::dvec3> chosen;
    double sum = 0;
    for (int i = 0; i < candidates; ++i) {
      const auto at = std::upper_bound(sums_.begin(), sums_.end(), unit(random) * sums_.back());
      if (at == sums_.end()) continue;
      const glm::dvec3 place(scene_.lights[std::size_t(at - sums_.begin())].position),
          way = place - from;
      if (!(glm::dot(way, normal) > 0)) continue;
      const double weight = 1 / (glm::dot(way, way) + 1);
      sum += weight;
      if (unit(random) * sum < weight) chosen = place;
    }
    return chosen;
  }

 private:
  const scene::RenderScene& scene_;
  std::vector<double> sums_;
};

}  // namespace

std::vector<gpu::ProbeRay> make_primary_rays(const scene::CameraPose& pose, std::uint32_t width,
                                             std::uint32_t height) {
  const gpu::Camera camera = scene::make_camera(pose, float(width) / float(height));
  std::vector<gpu::ProbeRay> rays;
  rays.reserve(std::size_t{width} * height);
  for (std::uint32_t top = 0; top < height; top += square)
    for (std::uint32_t left = 0; left < width; left += square)
      for (std::uint32_t y = top; y < std::min(top + square, height); ++y)
        for (std::uint32_t x = left; x < std::min(left + square, width); ++x) {
          const float sx = (float(x) + 0.5f) / float(width) * 2 - 1,
                      sy = 1 - (float(y) + 0.5f) / float(height) * 2;
          const glm::vec3 way =
              camera.forward +
              camera.tan_half_height * (sx * camera.aspect * camera.right + sy * camera.up);
          rays.push_back({camera.position, 1e30f, glm::normalize(way), 0});
        }
  return rays;
}

std::vector<gpu::ProbeRay> make_shadow_rays(const scene::RenderScene& scene,
                                            std::span<const gpu::ProbeRay> primary) {
  const LightDraw lights(scene);
  if (!lights.has_any()) return {};
  const std::size_t tasks = (primary.size() + at_once - 1) / at_once;
  std::vector<std::vector<gpu::ProbeRay>> parts(tasks);
  run_parallel(tasks, count_cores(), [&](std::size_t task) {
    std::mt19937 random(static_cast<std::uint32_t>(task));
    for (std::size_t i = task * at_once; i < std::min(primary.size(), (task + 1) * at_once); ++i) {
      const gpu::ProbeRay& ray = primary[i];
      const glm::dvec3 from(ray.from), way(ray.way);
      const auto hit = scene::trace_ray(scene, from, way, double(ray.t_max), MASK_VISIBLE);
      if (!hit) continue;
      const glm::dvec3 start = from + way * hit->distance + hit->normal * clearance_m;
      const auto light = lights.choose(start, hit->normal, random);
      if (!light) continue;
      parts[task].push_back(
          {glm::vec3(start), float(1 - short_of_light), glm::vec3(*light - start), 0});
    }
  });
  std::vector<gpu::ProbeRay> rays;
  for (const auto& part : parts) rays.insert(rays.end(), part.begin(), part.end());
  return rays;
}

}  // namespace nightcity::experiments
