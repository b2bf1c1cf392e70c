// A height field of triangles, as it is seen from above.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tools/mesh/triangle_mesh.h"

namespace nightcity::test {

/// Returns twice the area of a triangle in plan: positive where it faces up.
inline double find_plan_cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the area of a surface in plan, and expects that all of it faces up.
inline double find_plan_area(const mesh::TriangleMesh& mesh) {
  double sum = 0;
  for (const mesh::MeshTriangle& t : mesh.triangles) {
    const double area = find_plan_cross(mesh.positions[t.vertex[0]], mesh.positions[t.vertex[1]],
                                        mesh.positions[t.vertex[2]]) /
                        2;
    EXPECT_GT(area, 0) << "faces up";
    sum += area;
  }
  return sum;
}

/// Returns the height of a surface at a place, by the first triangle that holds it; NaN where none
/// does.
inline double find_height(const mesh::TriangleMesh& mesh, double x, double y) {
  for (const mesh::MeshTriangle& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t.vertex[0]], &b = mesh.positions[t.vertex[1]],
                     &c = mesh.positions[t.vertex[2]];
    const double all = find_plan_cross(a, b, c), u = find_plan_cross(a, {x, y}, c) / all,
                 v = find_plan_cross(a, b, {x, y}) / all;
    if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9)
      return a.z + u * (b.z - a.z) + v * (c.z - a.z);
  }
  return std::nan("");
}

}  // namespace nightcity::test
