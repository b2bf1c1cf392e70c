// The origin that a scene is rendered about, so that single precision serves wherever it lies.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "formats/light.h"
#include "runtime/scene/mesh_triangles.h"

namespace nightcity::scene {

/// Coordinates of a scene this far from its origin, m, are at most 2 mm apart. SPEC.md, section 1:
/// a writer keeps a scene within it.
constexpr double max_reach_m = 20'000;

/// Returns the place in model space, m, that a scene's coordinates are best relative to: model
/// space's own origin where at least a hundredth of the meshes that are placed, or of the lights,
/// comes within max_reach_m of it; else the middle of the meshes (the median of their boxes'
/// middles, which single ones astray do not move) in whole multiples of 1,024 m. Vehicles, and
/// boxes and lights that are not finite, do not count.
glm::dvec3 find_local_origin(const Scene& scene, const MeshSource& meshes,
                             std::span<const Light> lights);

}  // namespace nightcity::scene
