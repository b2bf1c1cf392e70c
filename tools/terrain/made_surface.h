// A ground for cities that come without one.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "tools/mesh/triangle_mesh.h"

namespace nightcity {

/// Delaunay surface (in plan) through `points`, with a rim `margin_m` outside their bounds at the height of
/// the nearest point. Of points with the same plan position the lowest counts. Empty for fewer than one
/// finite point.
TriangleMesh make_surface(std::vector<glm::dvec3> points, double margin_m);

}  // namespace nightcity
