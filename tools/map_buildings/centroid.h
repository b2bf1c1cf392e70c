// The centroid of an outline, and what it sees.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace nightcity::map_buildings {

/// Returns the centroid of the area of a ring, m; none where it runs clockwise or encloses nothing.
std::optional<glm::dvec2> find_centroid(const std::vector<glm::dvec2>& ring);

/// Returns whether a place lies on the inner side of each edge of a ring that runs anticlockwise.
bool sees_each_edge(const glm::dvec2& place, const std::vector<glm::dvec2>& ring);

}  // namespace nightcity::map_buildings
