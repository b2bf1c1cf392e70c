// Rays against every triangle: for a few rays, and as the oracle of the traversal's tests.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// Returns the distance along unit `direction` to the nearest triangle of an instance that shares a
/// bit with `mask`, up to `t_max`. Tests all triangles, in double.
std::optional<double> brute_force_hit(const RenderScene& scene, const glm::dvec3& origin,
                                      const glm::dvec3& direction, double t_max,
                                      std::uint32_t mask);

}  // namespace nightcity::scene
