// Moves elevation models to the heights that the buildings of a city stand at.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tools/bake/city/ground_heights.h"

namespace nightcity::bake {

/// Moves each kind of models by the median over the buildings' feet (footprint_points of a
/// Terrain), and one that has no height under any as the finest that has. Returns how it went, for
/// a report: "moved by +0.20 m to meet the buildings", and where many feet are still far off.
std::string meet_buildings(GroundHeights& heights, const std::vector<glm::dvec3>& feet);

}  // namespace nightcity::bake
