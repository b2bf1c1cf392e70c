#include "runtime/experiments/ray_set.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "formats/parallel.h"
#include "runtime/scene/alias_table.h"
#include "runtime/scene/trace_ray.h"

namespace nightcity::experiments {
namespace {

constexpr std::uint32_t square = 8;      // pixels a side
constexpr std::size_t at_once = 1024;    // rays of one task
constexpr int candidates = 24;           // lights
constexpr double clearance_m = 1e-2;     // of shadow rays off their surface
constexpr double short_of_light = 1e-3;  // share of the way at which they end before it

// Returns the place of one of the candidates that are in front of a surface, which are drawn by
// flux; nothing where all are behind it.
std::optional<glm::dvec3> choose_light(const scene::RenderScene& scene,
                                       std::span<const gpu::AliasEntry> by_flux,
                                       const glm::dvec3& from, const glm::dvec3& normal,
                                       std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::uniform_int_distribution<std::size_t> column(0, by_flux.size() - 1);
  std::optional<glm::dvec3> chosen;
  double sum = 0;
  for (int i = 0; i < candidates; ++i) {
    const std::size_t at = column(random);
    const gpu::AliasEntry& entry = by_flux[at];
    const std::size_t light = unit(random) < double(entry.keep) ? at : entry.alias;
    const glm::dvec3 place(scene.lights[light].position), way = place - from;
    if (!(glm::dot(way, normal) > 0)) continue;
    const double weight = 1 / (glm::dot(way, way) + 1);
    sum += weight;
    if (unit(random) * sum < weight) chosen = place;
  }
  return chosen;
}

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
          const glm::vec2 place = (glm::vec2(x, y) + 0.5f) / glm::vec2(width, height) * 2.0f - 1.0f;
          rays.push_back({camera.position, 1e30f, scene::direction_through(camera, place), 0});
        }
  return rays;
}

std::vector<gpu::ProbeRay> make_shadow_rays(const scene::RenderScene& scene,
                                            std::span<const gpu::ProbeRay> primary) {
  std::vector<float> fluxes;
  for (const Light& light : scene.lights) fluxes.push_back(light.flux_lm);
  if (std::none_of(fluxes.begin(), fluxes.end(), [](float flux) { return flux > 0; })) return {};
  const std::vector<gpu::AliasEntry> by_flux = scene::build_alias_table(fluxes);
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
      const auto light = choose_light(scene, by_flux, start, hit->normal, random);
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
