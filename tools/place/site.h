// Questions that stages ask about a place of the city: its coordinates, the height of its ground,
// whether a building stands there.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace nightcity::place {

/// WGS 84 longitude and latitude, degrees, to E, N of the city's frame, m.
using LonLatToFrame = std::function<glm::dvec2(const glm::dvec2& lon_lat)>;
/// Height of the ground at E, N of the city's frame, m; none outside the model.
using HeightAt = std::function<std::optional<double>(const glm::dvec2& place)>;
/// Returns the place (E, N, H) on the deck of the bridge that carries a way of the map, for what is
/// on the way or beside it at E, N; none where the way lies on the ground there.
using DeckAt =
    std::function<std::optional<glm::dvec3>(std::int64_t way_id, const glm::dvec2& place)>;
/// Returns whether E, N of the city's frame, m, lies within a building's footprint.
using InsideBuilding = std::function<bool(const glm::dvec2& place)>;

}  // namespace nightcity::place
