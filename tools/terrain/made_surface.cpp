#include "tools/terrain/made_surface.h"

// CGAL lives in this file and terrain.cpp alone: its headers are large.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

namespace nightcity {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Projection_traits_xy_3<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Traits>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Traits, Structure>;

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

double nearest_height(const std::vector<glm::dvec3>& points, const glm::dvec2& at) {
  double best = std::numeric_limits<double>::infinity(), height = 0;
  for (const glm::dvec3& p : points) {
    const double dx = p.x - at.x, dy = p.y - at.y, square = dx * dx + dy * dy;
    if (square < best) best = square, height = p.z;
  }
  return height;
}

void add_rim(std::vector<glm::dvec3>& points, double margin) {
  glm::dvec2 low(points[0]), high(points[0]);
  for (const glm::dvec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // At least a metre, so that a single point still gets a surface.
  margin = std::max(margin, 1.0);
  low -= margin;
  high += margin;
  constexpr int pieces = 8;  // a side
  std::vector<glm::dvec2> rim;
  for (int n = 0; n < pieces; ++n) {
    const double f = static_cast<double>(n) / pieces, g = 1 - f;
    rim.emplace_back(low.x + f * (high.x - low.x), low.y);
    rim.emplace_back(high.x, low.y + f * (high.y - low.y));
    rim.emplace_back(low.x + g * (high.x - low.x), high.y);
    rim.emplace_back(low.x, low.y + g * (high.y - low.y));
  }
  const std::size_t inner = points.size();
  std::vector<double> heights;
  for (const glm::dvec2& p : rim) heights.push_back(nearest_height(points, p));
  points.reserve(inner + rim.size());
  for (std::size_t n = 0; n < rim.size(); ++n) points.emplace_back(rim[n], heights[n]);
}

}  // namespace

TriangleMesh make_surface(std::vector<glm::dvec3> points, double margin_m) {
  std::erase_if(points, [](const glm::dvec3& p) { return !finite(p); });
  TriangleMesh mesh;
  if (points.empty()) return mesh;
  std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  points.erase(std::unique(points.begin(), points.end(),
                           [](const glm::dvec3& a, const glm::dvec3& b) { return a.x == b.x && a.y == b.y; }),
               points.end());
  add_rim(points, margin_m);

  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> input;
  input.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    input.emplace_back(Kernel::Point_3(points[n].x, points[n].y, points[n].z), static_cast<std::uint32_t>(n));
  Delaunay delaunay;
  delaunay.insert(input.begin(), input.end());  // in space-filling order: 1.1 M points/s instead of 6 k

  mesh.positions = std::move(points);
  mesh.triangles.reserve(delaunay.number_of_faces());
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face)
    mesh.triangles.push_back({{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()},
                              SurfaceType::terrain,
                              0});
  return mesh;
}

}  // namespace nightcity
