// The ground between the edge of a city's own ground and the horizon.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/mesh/triangle_mesh.h"

namespace nightcity::terrain {

/// How far it reaches beyond the ground, m. Who stands h above it sees to sqrt(2 R h) where the
/// earth (radius R) hides the rest: here from up to 196 m. Higher up haze does: visibility
/// (Koschmieder 1924) rarely exceeds 50 km in a city's air.
constexpr double horizon_m = 50'000;
/// The mean radius of the earth, m (IUGG, Moritz 2000). Refraction is left out.
constexpr double earth_radius_m = 6'371'009;

/// Returns the surface around rings of Outline::find_rings (E, N, H, m). It begins with the rings'
/// own vertices, so that nothing shows between it and the ground; its height becomes their mean,
/// within 500 m or so that grades from the mean are 4 % at most, and falls by d^2 / 2R with the
/// distance d from the ground, as the earth does. Its triangles face upwards and grow with the
/// distance. Empty without rings. Throws Error where rings cross each other too often.
mesh::TriangleMesh make_horizon(std::span<const std::vector<glm::dvec3>> rings);

}  // namespace nightcity::terrain
