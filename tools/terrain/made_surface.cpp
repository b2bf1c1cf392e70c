#include "tools/terrain/made_surface.h"

// The only file of this library that includes CGAL: its headers are large.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "formats/finite.h"

namespace nightcity::terrain {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Projection_traits_xy_3<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Traits>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Traits, Structure>;
struct FaceMark {
  bool is_outside = false;
};
using ConstrainedFace = CGAL::Constrained_triangulation_face_base_2<
    Traits, CGAL::Triangulation_face_base_with_info_2<FaceMark, Traits>>;
using ConstrainedStructure = CGAL::Triangulation_data_structure_2<VertexBase, ConstrainedFace>;
// The tag splits lines that cross, which would throw otherwise.
using Constrained = CGAL::Constrained_Delaunay_triangulation_2<Traits, ConstrainedStructure,
                                                               CGAL::Exact_predicates_tag>;

constexpr int rim_points = 32;

double find_nearest_height(const std::vector<glm::dvec3>& points, const glm::dvec2& at) {
  double best = std::numeric_limits<double>::infinity(), height = 0;
  for (const glm::dvec3& p : points) {
    const double dx = p.x - at.x, dy = p.y - at.y, square = dx * dx + dy * dy;
    if (square < best) best = square, height = p.z;
  }
  return height;
}

void add_rim(std::vector<glm::dvec3>& points, double margin, const std::optional<Extent>& reach) {
  glm::dvec2 low(points[0]), high(points[0]);
  for (const glm::dvec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // At least a metre, so that a single point still gets a surface.
  margin = std::max(margin, 1.0);
  low -= margin;
  high += margin;
  if (reach) {
    low = glm::min(low, reach->low);
    high = glm::max(high, reach->high);
  }
  constexpr int pieces = rim_points / 4;  // a side
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
  for (const glm::dvec2& p : rim) heights.push_back(find_nearest_height(points, p));
  points.reserve(inner + rim.size());
  for (std::size_t n = 0; n < rim.size(); ++n) points.emplace_back(rim[n], heights[n]);
}

// Sorts the points by place, keeps one per place, and adds the rim at the end.
void prepare(std::vector<glm::dvec3>& points, double margin_m,
             const std::optional<Extent>& reach = {}) {
  std::erase_if(points, [](const glm::dvec3& p) { return !finite(p); });
  if (points.empty()) return;
  std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  points.erase(std::unique(points.begin(), points.end(),
                           [](const glm::dvec3& a, const glm::dvec3& b) {
                             return a.x == b.x && a.y == b.y;
                           }),
               points.end());
  add_rim(points, margin_m, reach);
}

template <class Triangulation>
void insert_points(Triangulation& triangulation, const std::vector<glm::dvec3>& points) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> input;
  input.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    input.emplace_back(Kernel::Point_3(points[n].x, points[n].y, points[n].z),
                       static_cast<std::uint32_t>(n));
  // CGAL inserts a range in space-filling order: 1.1 M points/s instead of 6 k.
  triangulation.insert(input.begin(), input.end());
}

// `is_shown` decides by a face's handle. Vertices' numbers are places in `positions`.
template <class Triangulation, class IsShown>
mesh::TriangleMesh to_mesh(const Triangulation& triangulation, std::vector<glm::dvec3> positions,
                           const IsShown& is_shown) {
  mesh::TriangleMesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles.reserve(triangulation.number_of_faces());
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face)
    if (is_shown(typename Triangulation::Face_handle(face)))
      mesh.triangles.push_back(
          {{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()},
           city::SurfaceType::terrain,
           0});
  return mesh;
}

constexpr auto every_face = [](const auto&) { return true; };

// A Delaunay triangulation through points with lines that are edges of it.
class ConstrainedSurface {
 public:
  // `points` are as prepare() leaves them, and outlive the object.
  explicit ConstrainedSurface(const std::vector<glm::dvec3>& points)
      // n lines may cross n^2 times. The few crossings of a real file are kept; a hostile file gets
      // no more.
      : points_(points), max_vertices_(2 * points.size() + 1000) {
    insert_points(surface_, points_);
    vertices_.resize(points_.size());
    for (auto v = surface_.finite_vertices_begin(); v != surface_.finite_vertices_end(); ++v)
      vertices_[v->info()] = v;
  }

  // The vertices of a line are among the points.
  void add_line(std::span<const glm::dvec3> line) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const auto a = vertex_at(line[k]), b = vertex_at(line[k + 1]);
      if (a == Constrained::Vertex_handle{} || b == Constrained::Vertex_handle{} || a == b)
        continue;
      if (surface_.number_of_vertices() > max_vertices_) {
        ++unused_edges_;
        continue;
      }
      surface_.insert_constraint(a, b);
      ++edges_;
    }
  }

  // Marks the faces that can be reached from outside without crossing a line.
  void mark_outside() {
    std::vector<Constrained::Face_handle> waiting{surface_.infinite_face()};
    waiting.front()->info().is_outside = true;
    while (!waiting.empty()) {
      const Constrained::Face_handle face = waiting.back();
      waiting.pop_back();
      for (int side = 0; side < 3; ++side) {
        const Constrained::Face_handle next = face->neighbor(side);
        if (next->info().is_outside || face->is_constrained(side)) continue;
        next->info().is_outside = true;
        waiting.push_back(next);
      }
    }
  }

  // Returns whether a point lies in a face that is marked, and on no line.
  bool is_outside(const glm::dvec3& p) const {
    const auto found = surface_.locate(Kernel::Point_3(p.x, p.y, p.z), vertices_.front()->face());
    if (found == Constrained::Face_handle{} || surface_.is_infinite(found)) return true;
    return found->info().is_outside;
  }

  // Returns the faces that `is_shown`.
  template <class IsShown>
  mesh::TriangleMesh make_mesh(const IsShown& is_shown) {
    std::vector<glm::dvec3> positions;
    for (auto v = surface_.finite_vertices_begin(); v != surface_.finite_vertices_end(); ++v) {
      v->info() = static_cast<std::uint32_t>(positions.size());
      positions.emplace_back(v->point().x(), v->point().y(), v->point().z());
    }
    return to_mesh(surface_, std::move(positions), is_shown);
  }

  std::size_t edges() const { return edges_; }
  std::size_t unused_edges() const { return unused_edges_; }

 private:
  Constrained::Vertex_handle vertex_at(const glm::dvec3& p) const {
    if (!finite(p)) return {};
    const auto found = std::lower_bound(points_.begin(), points_.end() - rim_points, p,
                                        [](const glm::dvec3& a, const glm::dvec3& b) {
                                          return std::tie(a.x, a.y) < std::tie(b.x, b.y);
                                        });
    return vertices_[static_cast<std::size_t>(found - points_.begin())];
  }

  const std::vector<glm::dvec3>& points_;
  std::size_t max_vertices_;
  Constrained surface_;
  std::vector<Constrained::Vertex_handle> vertices_;
  std::size_t edges_ = 0, unused_edges_ = 0;
};

}  // namespace

mesh::TriangleMesh make_surface(std::vector<glm::dvec3> points, double margin_m,
                                const std::optional<Extent>& reach) {
  prepare(points, margin_m, reach);
  if (points.empty()) return {};
  Delaunay delaunay;
  insert_points(delaunay, points);
  return to_mesh(delaunay, std::move(points), every_face);
}

BreakSurface make_surface(std::vector<glm::dvec3> points,
                          std::span<const std::vector<glm::dvec3>> lines, double margin_m) {
  for (const auto& line : lines) points.insert(points.end(), line.begin(), line.end());
  prepare(points, margin_m);
  BreakSurface result;
  if (points.empty()) return result;
  ConstrainedSurface surface(points);
  for (const auto& line : lines) surface.add_line(line);
  result.edges = surface.edges();
  result.unused_edges = surface.unused_edges();
  result.mesh = surface.make_mesh(every_face);
  return result;
}

SurfaceAround make_surface_around(std::span<const std::vector<glm::dvec3>> rings,
                                  std::vector<glm::dvec3> points, double margin_m) {
  std::erase_if(points, [](const glm::dvec3& p) { return !finite(p); });
  const std::vector<glm::dvec3> asked = points;
  // The lowest point of a vertical line stays, and a ring's must.
  std::set<std::pair<double, double>> taken;
  for (const auto& ring : rings)
    for (const glm::dvec3& p : ring) taken.emplace(p.x, p.y);
  std::erase_if(points, [&](const glm::dvec3& p) { return taken.contains({p.x, p.y}); });
  for (const auto& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  prepare(points, margin_m);
  SurfaceAround result;
  if (points.empty()) return result;
  ConstrainedSurface surface(points);
  for (std::vector<glm::dvec3> ring : rings) {
    if (ring.empty()) continue;
    ring.push_back(ring.front());
    surface.add_line(ring);
  }
  surface.mark_outside();
  result.points = static_cast<std::size_t>(std::count_if(
      asked.begin(), asked.end(), [&](const glm::dvec3& p) { return surface.is_outside(p); }));
  result.mesh =
      surface.make_mesh([](Constrained::Face_handle face) { return face->info().is_outside; });
  return result;
}

}  // namespace nightcity::terrain
