// Barriers of a map in metres, on a slope with a house.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "tools/barriers/barrier_shape.h"
#include "tools/barriers/find_barriers.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::barriers {

// Degrees stand for metres here; the ground rises eastwards within 500 m, and a house of 20 m
// stands at the origin.
inline const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
inline const place::HeightAt ground = [](const glm::dvec2& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) <= 500 ? std::optional(p.x / 10) : std::nullopt;
};
inline const place::InsideBuilding house = [](const glm::dvec2& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) < 10;
};
inline constexpr ground_cover::Box bounds{{-500, -500}, {500, 500}};

inline osm::OsmWay way(std::vector<glm::dvec2> line, osm::OsmTags tags) {
  return {1, std::move(line), std::move(tags)};
}

inline osm::OsmWay wall_along(std::vector<glm::dvec2> line) {
  return way(std::move(line), {{"barrier", "wall"}});
}

// A wall 0.8 m wide.
inline osm::OsmWay thick_wall(std::vector<glm::dvec2> line) {
  return way(std::move(line), {{"barrier", "wall"}, {"width", "0.8"}, {"height", "2"}});
}

// Corners of the shapes of all walls.
inline std::vector<glm::dvec3> find_corners(const BarrierSet& set) {
  std::vector<glm::dvec3> corners;
  for (const BarrierLine& line : set.lines)
    for (const Corners& triangle : make_shape(line))
      corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

inline BarrierSet find(const osm::OsmData& map) {
  ground_cover::Cover cover;
  ground_cover::add_streets(map.highways, true, as_metres, bounds, cover);
  cover.finish();
  BarrierSet set = find_barriers(map, cover, bounds, as_metres, ground, house);
  // Everything mapped is built or left out, and everything built lies in the lines.
  double mapped_m = 0, built_m = 0, left_out_m = 0, lines_m = 0;
  for (const auto& [name, kind] : set.report.kinds)
    mapped_m += kind.mapped_m, built_m += kind.built_m;
  for (const auto& [reason, m] : set.report.left_out_m) left_out_m += m;
  EXPECT_NEAR(mapped_m, built_m + left_out_m, 1e-9 * mapped_m + 1e-6);
  for (const BarrierLine& line : set.lines) {
    const std::size_t n = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i)
      lines_m += glm::distance(glm::dvec2(line.points[i]), glm::dvec2(line.points[(i + 1) % n]));
  }
  if (set.areas.empty()) {
    EXPECT_NEAR(lines_m, built_m, 1e-6 * (1 + built_m));
  }
  return set;
}

}  // namespace nightcity::barriers
