// Constrained Delaunay triangulation of crossing-tolerant outlines.
// Exact_predicates_tag splits crossing constraints instead of throwing, and Constrained_triangulation_plus_2
// knows how many outlines run along an edge: a hole that shares an edge with the shell counts twice there, so
// the parity does not change across it. (Plain nesting depth gets that case wrong.)
#include "tools/mesh/constrained.h"

#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <limits>
#include <utility>

#include "tools/mesh/constrained_delaunay.h"

namespace nightcity {
namespace {

constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();

enum class Side : std::uint8_t { unknown, outside, inside };

struct VertexInfo {
  std::uint32_t index = unset;
};
struct FaceInfo {
  Side side = Side::unknown;
};

using Kernel = PlaneKernel;
using Triangulation = CGAL::Constrained_triangulation_plus_2<ConstrainedDelaunay<
    FaceInfo, CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, PlaneKernel>>>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

void insert_outlines(Triangulation& triangulation, std::span<const glm::dvec2> points,
                     std::span<const std::vector<std::uint32_t>> outlines) {
  // Where the last vertex lies is where the next one's search begins. (The vertex stays; its face may be
  // replaced.)
  Vertex last{};
  for (const std::vector<std::uint32_t>& outline : outlines) {
    std::vector<Vertex> vertices;
    vertices.reserve(outline.size());
    for (const std::uint32_t i : outline) {
      const Vertex v = triangulation.insert(Kernel::Point_2(points[i].x, points[i].y),
                                            last == Vertex{} ? Face{} : last->face());
      if (v->info().index == unset) v->info().index = i;  // else a place seen before
      last = v;
      vertices.push_back(v);
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vertex a = vertices[i], b = vertices[(i + 1) % vertices.size()];
      if (a != b) triangulation.insert_constraint(a, b);
    }
  }
}

void mark_sides(Triangulation& triangulation) {
  std::vector<Face> open{triangulation.infinite_face()};
  open.back()->info().side = Side::outside;
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Face next = face->neighbor(i);
      if (next->info().side != Side::unknown) continue;
      Side side = face->info().side;
      if (face->is_constrained(i)) {
        const auto enclosing = triangulation.number_of_enclosing_constraints(
            face->vertex(Triangulation::ccw(i)), face->vertex(Triangulation::cw(i)));
        if (enclosing % 2 == 1) side = side == Side::inside ? Side::outside : Side::inside;
      }
      next->info().side = side;
      open.push_back(next);
    }
  }
}

}  // namespace

FlatTriangulation triangulate_flat(std::span<const glm::dvec2> points,
                                   std::span<const std::vector<std::uint32_t>> outlines) {
  FlatTriangulation out;
  out.points.assign(points.begin(), points.end());
  Triangulation triangulation;
  insert_outlines(triangulation, points, outlines);
  if (triangulation.dimension() < 2) return out;  // all on one line
  for (const Vertex v : triangulation.finite_vertex_handles()) {
    if (v->info().index != unset) continue;
    out.crossing = true;
    v->info().index = static_cast<std::uint32_t>(out.points.size());
    out.points.emplace_back(v->point().x(), v->point().y());
  }
  mark_sides(triangulation);
  for (const Face face : triangulation.finite_face_handles()) {
    if (face->info().side != Side::inside) continue;
    out.triangles.push_back({face->vertex(0)->info().index, face->vertex(1)->info().index,
                             face->vertex(2)->info().index});
  }
  return out;
}

}  // namespace nightcity
