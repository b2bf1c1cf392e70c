// A map whose coordinates are metres, and the part of it that tests look at.
#pragma once

#include <glm/vec2.hpp>

#include "tools/ground_cover/box_index.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {

inline const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
constexpr Box bounds{{-500, -500}, {500, 500}};

}  // namespace nightcity::ground_cover
