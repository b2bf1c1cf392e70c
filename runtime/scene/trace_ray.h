// Rays through a scene's hierarchies on the CPU: for picking, walking and finding places.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

struct RayHit {
  double distance;         // in units of the direction's length
  std::uint32_t instance;  // index into RenderScene::instances
  std::uint32_t triangle;  // index into RenderScene::triangles
  glm::dvec3 normal;       // unit, model space, towards the ray's origin
};

/// Returns the nearest hit at a distance in (0, t_max) on an instance that shares a bit with `mask`
/// (MASK_*). Boxes are tested conservatively and triangles in double, as brute_force_hit does.
/// Vehicles move on the device alone and are not hit.
std::optional<RayHit> trace_ray(const RenderScene& scene, const glm::dvec3& origin,
                                const glm::dvec3& direction, double t_max, std::uint32_t mask);

}  // namespace nightcity::scene
