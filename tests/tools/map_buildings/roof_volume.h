// Roofs over a rectangle, and the volume below them.
#pragma once

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "tools/city/ring.h"
#include "tools/map_buildings/roofs.h"

namespace nightcity::map_buildings {

// 10 m along x, 6 m along y.
inline const Outline rectangle{{{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {}};

inline BuildingSizes sizes(RoofShape roof, double foot = 0, double eaves = 5, double top = 8) {
  BuildingSizes s;
  s.roof = roof;
  s.foot_m = foot;
  s.eaves_m = roof == RoofShape::flat ? top : eaves;
  s.top_m = top;
  return s;
}

// By the divergence theorem; holes count with their own direction.
inline double shell_volume(const std::vector<city::Polygon>& shell) {
  double sum = 0;
  for (const city::Polygon& polygon : shell) {
    glm::dvec3 vector = city::area_vector(polygon.exterior);
    for (const city::Ring& hole : polygon.interiors) vector += city::area_vector(hole);
    sum += glm::dot(vector, polygon.exterior.front()) / 3;
  }
  return sum;
}

// Returns whether each edge runs once each way: then the shell is closed and faces one way.
inline bool is_closed(const std::vector<city::Polygon>& shell) {
  std::map<std::tuple<double, double, double, double, double, double>, int> edges;
  const auto add = [&](const city::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (a == b) continue;
      ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
      --edges[{b.x, b.y, b.z, a.x, a.y, a.z}];
    }
  };
  for (const city::Polygon& polygon : shell) {
    add(polygon.exterior);
    for (const city::Ring& hole : polygon.interiors) add(hole);
  }
  for (const auto& [edge, count] : edges)
    if (count != 0) return false;
  return true;
}

inline void expect_shell(const Outline& outline, const BuildingSizes& s, double expected,
                         bool expect_flat = false) {
  bool flat = false;
  const auto shell = make_shell(outline, s, flat);
  EXPECT_EQ(flat, expect_flat);
  EXPECT_TRUE(is_closed(shell));
  EXPECT_NEAR(shell_volume(shell), expected, 1e-6);
}

inline double volume_of(const Outline& outline, const BuildingSizes& s) {
  bool flat = false;
  const auto shell = make_shell(outline, s, flat);
  EXPECT_FALSE(flat);
  EXPECT_TRUE(is_closed(shell));
  double top = 0;
  for (const city::Polygon& polygon : shell)
    for (const glm::dvec3& p : polygon.exterior) top = std::max(top, p.z);
  EXPECT_EQ(top, s.top_m);
  return shell_volume(shell);
}

}  // namespace nightcity::map_buildings
