#include "runtime/scene/standpoint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/trace_ray.h"

namespace nightcity::scene {
namespace {

constexpr float eye_height_m = 1.7f;
constexpr double free_m = 1.5;        // nearest wall around a place to stand
constexpr double sight_m = 250;       // farther ahead makes a view no better
constexpr double street_half_m = 20;  // walls within this distance to the side make a street
constexpr float roof_m = 2.5f;        // higher than the lowest ground around: a roof, not a street
constexpr double around_m = 30;       // where that ground is looked for
constexpr double full_turn = 2 * 3.14159265358979;

// Returns the height of the topmost surface at a place, nothing beside the model.
std::optional<double> find_top(const RenderScene& scene, double x, double z) {
  const double above = double(scene.bounds.upper.y) + 1;
  const auto hit = trace_ray(scene, {x, above, z}, {0, -1, 0}, 1e6, MASK_SHADOW);
  if (!hit) return std::nullopt;
  return above - hit->distance;
}

// Returns where a pedestrian's eye would be at a place, unless that is a roof: the topmost surface
// there is much higher than the lowest around it.
std::optional<glm::dvec3> find_eye(const RenderScene& scene, double x, double z) {
  const std::optional<double> here = find_top(scene, x, z);
  if (!here) return std::nullopt;
  double lowest = *here;
  for (int i = 0; i < sight_count; i += 4)
    for (const double share : {0.3, 1.0}) {
      const glm::dvec3 at = glm::dvec3(x, 0, z) + share * around_m * direction_of(i);
      lowest = std::min(lowest, find_top(scene, at.x, at.z).value_or(lowest));
    }
  if (*here > lowest + double(roof_m)) return std::nullopt;
  return glm::dvec3(x, *here + double(eye_height_m), z);
}

double open_at(const Standpoint& from, int sight) {
  return from.open[static_cast<std::size_t>((sight + sight_count) % sight_count)];
}

}  // namespace

glm::dvec3 direction_of(int sight) {
  const double angle = full_turn * sight / sight_count;
  return {std::cos(angle), 0, std::sin(angle)};
}

int find_sight(const glm::dvec3& direction) {
  const double angle = std::atan2(direction.z, direction.x);
  return (static_cast<int>(std::lround(angle / full_turn * sight_count)) + sight_count) %
         sight_count;
}

std::optional<Standpoint> find_standpoint(const RenderScene& scene, double x, double z) {
  const std::optional<glm::dvec3> eye = find_eye(scene, x, z);
  if (!eye) return std::nullopt;
  Standpoint from{*eye, {}};
  for (int i = 0; i < sight_count; ++i) {
    const auto hit = trace_ray(scene, *eye, direction_of(i), sight_m, MASK_VISIBLE);
    const double open = hit ? hit->distance : sight_m;
    if (open < free_m) return std::nullopt;
    from.open[static_cast<std::size_t>(i)] = open;
  }
  return from;
}

double rate_view(const Standpoint& from, int sight) {
  constexpr int half = sight_count / 2, quarter = sight_count / 4;
  const double ahead = std::min(open_at(from, sight), 150.0),
               behind = std::min(open_at(from, sight + half), 60.0);
  const double left = open_at(from, sight - quarter), right = open_at(from, sight + quarter);
  const int walls = (left < street_half_m) + (right < street_half_m);
  const double middle = std::min(left, right) / std::max(1.0, std::max(left, right));
  return std::sqrt(ahead) * (1 + walls) * (0.5 + std::min(middle, 1.0)) * (1 + behind / 60);
}

double rate_lights(const RenderScene& scene, const Standpoint& from, int sight) {
  const glm::dvec3 ahead = direction_of(sight);
  const double open = open_at(from, sight);
  double sum = 0;
  for (const Light& light : scene.lights) {
    if (!(light.flux_lm > 0)) continue;
    const glm::dvec3 to = glm::dvec3(light.position) - from.eye;
    const double along = glm::dot(to, ahead);
    if (along > 5 && along < open && glm::length(to - along * ahead) < 0.4 * along)
      sum += 1 / (1 + along / 60);
  }
  return sum;
}

CameraPose look_from(const Standpoint& from, const glm::dvec3& ahead) {
  CameraPose pose;
  pose.position = glm::vec3(from.eye);
  pose.target = glm::vec3(from.eye + 30.0 * ahead + glm::dvec3(0, 1.5, 0));
  pose.fov_deg = 65;
  return pose;
}

}  // namespace nightcity::scene
