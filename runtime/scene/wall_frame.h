// The direction and the size of a scene's static geometry, for the frame of its boxes
// (formats/hierarchy/box_frame.h).
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "runtime/scene/mesh_placement.h"
#include "runtime/scene/triangle_list.h"

namespace nightcity::scene {

/// Returns x and z of the unit vector that the walls follow among the triangles from `first` to
/// before `end`, as some of these show it.
glm::vec2 find_wall_direction(const TriangleList& triangles, std::size_t first, std::size_t end);

/// Returns the greatest coordinate, m, relative to `origin`, of the boxes of the meshes that stand
/// in a scene, but for its horizon; as far as these are known.
double find_reach(const Scene& scene, const MeshSource& meshes, const MeshPlacement& placement,
                  const glm::dvec3& origin);

}  // namespace nightcity::scene
