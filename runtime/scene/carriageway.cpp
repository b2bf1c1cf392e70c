#include "runtime/scene/carriageway.h"

#include <algorithm>
#include <array>

#include "runtime/scene/trace_ray.h"

namespace nightcity::scene {
namespace {

constexpr double sample_m = 2.5;
constexpr std::array sides_m{0.0, 2.0, -2.0, 4.0, -4.0};
constexpr double ground_reach_m =
    3;  // of rays to the ground, below and above the feet of a pedestrian

// Returns whether the first surface below `from` within `length_m` is a carriageway's.
bool is_carriageway_below(const RenderScene& scene, const glm::dvec3& from, double length_m) {
  const auto hit = trace_ray(scene, from, {0, -1, 0}, length_m, MASK_SHADOW);
  if (!hit) return false;
  // Surfaces with pictures have a colour there instead (MATERIAL_IS_COLOUR), and no material.
  const std::uint32_t material = scene.triangles[hit->triangle].material;
  return material < scene.carriageways.size() && scene.carriageways[material];
}

}  // namespace

bool has_carriageways(const RenderScene& scene) {
  return scene.triangles.any_material([&](std::uint32_t material) {
    return material < scene.carriageways.size() && scene.carriageways[material];
  });
}

bool stands_on_carriageway(const RenderScene& scene, const glm::dvec3& eye) {
  return is_carriageway_below(scene, eye, ground_reach_m);
}

double find_carriageway_ahead(const RenderScene& scene, const glm::dvec3& eye,
                              const glm::dvec3& ahead, double most_m) {
  const glm::dvec3 aside(-ahead.z, 0, ahead.x);
  double reached_m = 0;
  for (double at = 0; at <= most_m; at += sample_m) {
    const double rise_m = at / 5;
    const glm::dvec3 above = eye + at * ahead + glm::dvec3(0, rise_m, 0);
    const bool goes_on = std::any_of(sides_m.begin(), sides_m.end(), [&](double side_m) {
      return is_carriageway_below(scene, above + side_m * aside, ground_reach_m + 2 * rise_m);
    });
    if (!goes_on) break;
    reached_m = at;
  }
  return reached_m;
}

}  // namespace nightcity::scene
