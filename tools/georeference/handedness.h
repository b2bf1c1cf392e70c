// Whether x, y, z of a file is right-handed, told from its rings alone.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace nightcity {

/// `closed_rings`: rings one after the other, the last vertex of each repeating its first. CityGML's solids
/// have their normals outward and its terrain has them up, so a file whose axes are swapped (x is north)
/// shows them the wrong way round. Returns a score in [-1, 1]: above 0 right-handed (x east, y north), below
/// 0 swapped; near 0 nothing can be said.
double handedness(std::span<const glm::dvec3> closed_rings);

}  // namespace nightcity
