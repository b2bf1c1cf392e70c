#include "runtime/scene/point_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/schedule.h"
#include "runtime/scene/trace_ray.h"

namespace nightcity::scene {
namespace {

using std::numbers::pi;
constexpr double faint = 1e-3;              // share of the sum below which a light may be left out
constexpr std::size_t max_tested = 20'000;  // shadow rays: some tens of milliseconds
constexpr double clear_m = 1e-3;            // off the surface, where rays start

double rectangle_lux(const Light& light, const glm::dvec3& point, const glm::dvec3& normal) {
  const glm::dvec3 axis(light.axis), right(light.tangent), up = glm::cross(axis, right);
  const double width = double(half_width(light)), height = double(light.half_height);
  const double near = glm::length(glm::dvec3(light.position) - point) / std::max(width, height);
  const int patches = near > 20 ? 1 : near > 5 ? 4 : 16;  // along each side
  double sum = 0;
  for (int i = 0; i < patches; ++i)
    for (int k = 0; k < patches; ++k) {
      const glm::dvec3 at = glm::dvec3(light.position) +
                            (2 * (i + 0.5) / patches - 1) * width * right +
                            (2 * (k + 0.5) / patches - 1) * height * up;
      const glm::dvec3 way = at - point;
      const double square = glm::dot(way, way);
      if (square <= 0) continue;
      const glm::dvec3 to = way / std::sqrt(square);
      sum += std::max(0.0, glm::dot(to, normal)) * std::max(0.0, -glm::dot(to, axis)) / square;
    }
  return double(light.flux_lm) / pi * sum / (patches * patches);
}

double sphere_lux(const RenderScene& scene, const Light& light, const glm::dvec3& point,
                  const glm::dvec3& normal) {
  const glm::dvec3 way = glm::dvec3(light.position) - point;
  const double square = glm::dot(way, way);
  if (square <= 0) return 0;
  const glm::dvec3 to = way / std::sqrt(square);
  return std::max(0.0, glm::dot(to, normal)) * double(light.flux_lm) *
         intensity_per_lumen(scene, light, -to) / square;
}

bool shines(const RenderScene& scene, const Light& light, double time_s) {
  if (!(light.flux_lm > 0)) return false;
  return light.schedule == LIGHT_ALWAYS_ON || light.schedule >= scene.schedules.size() ||
         is_lit(scene.schedules[light.schedule], scene.switches, time_s);
}

bool is_shadowed(const RenderScene& scene, const Light& light, const glm::dvec3& from) {
  const glm::dvec3 way = glm::dvec3(light.position) - from;
  // Up to the luminous surface: the housing is not its shadow, nor the wall that a window lies in.
  const double margin = std::max(double(light.radius), 0.01) / std::max(glm::length(way), 0.02);
  const double end = light_kind(light) == LightKind::sphere ? 1 - std::min(0.5, margin) : 1 - 1e-4;
  return trace_ray(scene, from, way, end, MASK_SHADOW).has_value();
}

}  // namespace

double intensity_per_lumen(const RenderScene& scene, const Light& light, const glm::dvec3& to) {
  const std::uint32_t index = light_profile(light);
  if (index == LIGHT_NO_PROFILE || index >= scene.profiles.size()) return 1 / (4 * pi);
  const LightProfile& profile = scene.profiles[index];
  const glm::dvec3 axis(light.axis), tangent(light.tangent);
  const glm::dvec3 local(glm::dot(to, tangent), glm::dot(to, glm::cross(axis, tangent)),
                         glm::dot(to, axis));
  const double angle = std::atan2(std::hypot(local.x, local.y), local.z) * 180 / pi;
  if (angle > double(profile.extent_deg)) return 0;
  const double gamma = angle * (profile.gamma_count - 1) / double(profile.extent_deg);
  const auto g0 = std::min(static_cast<std::uint32_t>(gamma), profile.gamma_count - 2);
  double turn = std::atan2(local.y, local.x) / (2 * pi);
  turn = (turn - std::floor(turn)) * profile.c_count;
  const auto c0 = std::min(static_cast<std::uint32_t>(turn), profile.c_count - 1);
  const std::uint32_t c1 = c0 + 1 == profile.c_count ? 0 : c0 + 1;
  const double fg = gamma - g0, fc = turn - c0;
  const auto row = [&](std::uint32_t c) {
    const std::size_t at = std::size_t{profile.data_offset} + c * profile.gamma_count + g0;
    return (1 - fg) * double(scene.profile_data[at]) + fg * double(scene.profile_data[at + 1]);
  };
  return (1 - fc) * row(c0) + fc * row(c1);
}

double illuminance_of(const RenderScene& scene, const Light& light, const glm::dvec3& point,
                      const glm::dvec3& normal) {
  switch (light_kind(light)) {
    case LightKind::sphere:
      return sphere_lux(scene, light, point, normal);
    case LightKind::rectangle:
      return rectangle_lux(light, point, normal);
  }
  return 0;
}

PointLight find_light_at(const RenderScene& scene, const glm::dvec3& point,
                         const glm::dvec3& normal, double time_s, std::size_t most,
                         LightFamilies on) {
  PointLight result;
  const glm::dvec3 from = point + clear_m * normal;
  double rest = 0;
  std::vector<LightShare> candidates;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (!has_family(on, scene.families[i]) || !shines(scene, light, time_s)) continue;
    const double lux = illuminance_of(scene, light, point, normal);
    if (!(lux > 0)) continue;
    candidates.push_back({i, lux, glm::distance(glm::dvec3(light.position), point)});
    rest += lux;
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const LightShare& a, const LightShare& b) { return a.lux > b.lux; });
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (k == max_tested || (k >= most && rest < faint * result.lux)) {
      result.untested = candidates.size() - k;
      break;
    }
    rest -= candidates[k].lux;
    if (is_shadowed(scene, scene.lights[candidates[k].light], from)) continue;
    result.lux += candidates[k].lux;
    ++result.lit;
    if (result.strongest.size() < most) result.strongest.push_back(candidates[k]);
  }
  return result;
}

}  // namespace nightcity::scene
