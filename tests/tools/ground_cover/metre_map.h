// A map whose coordinates are metres, and the part of it that tests look at.
#pragma once

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "tools/ground_cover/box_index.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {

inline const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
constexpr Box bounds{{-500, -500}, {500, 500}};
constexpr Box middle{{-50, -40}, {50, 40}};  // 100 m of a way along x

inline osm::OsmWay way(std::vector<glm::dvec2> line, osm::OsmTags tags) {
  return {1, std::move(line), std::move(tags)};
}

}  // namespace nightcity::ground_cover
