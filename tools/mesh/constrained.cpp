// Constrained Delaunay triangulation of outlines that may cross. Constrained_triangulation_plus_2
// knows how many outlines run along an edge: a hole that shares an edge with the shell counts twice
// there, so the parity does not change across it. (Plain nesting depth gets that case wrong.)
#include "tools/mesh/constrained.h"

#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <limits>
#include <string>
#include <utility>

#include "formats/error.h"
#include "tools/mesh/constrained_delaunay.h"

namespace nightcity::mesh {
namespace {

constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();

enum class Side : std::uint8_t { unknown, outside, inside };

struct VertexInfo {
  std::uint32_t index = unset;
};
struct FaceInfo {
  Side side = Side::unknown;
};

// n edges may cross n^2 / 2 times. Real rings cross a few times; a hostile one must not take
// minutes.
constexpr std::size_t max_crossings_a_point = 16;

template <class Outlines>
class Flattener {
 public:
  explicit Flattener(std::span<const glm::dvec2> points) {
    out_.points.assign(points.begin(), points.end());
  }

  FlatTriangulation run(std::span<const std::vector<std::uint32_t>> outlines) {
    insert(outlines);
    if (triangulation_.dimension() < 2) return std::move(out_);  // all on one line
    add_crossings();
    mark_sides();
    for (const Face face : triangulation_.finite_face_handles()) {
      if (face->info().side != Side::inside) continue;
      out_.triangles.push_back({face->vertex(0)->info().index, face->vertex(1)->info().index,
                                face->vertex(2)->info().index});
    }
    return std::move(out_);
  }

 private:
  using Kernel = typename Outlines::Kernel;
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;

 public:
  using Triangulation = CGAL::Constrained_triangulation_plus_2<
      ConstrainedDelaunay<FaceInfo, VertexBase, Kernel, typename Outlines::Tag>>;

 private:
  using Face = typename Triangulation::Face_handle;
  using Vertex = typename Triangulation::Vertex_handle;

  void insert(std::span<const std::vector<std::uint32_t>> outlines) {
    const std::size_t max_vertices = (1 + max_crossings_a_point) * out_.points.size();
    // The search for the next vertex begins at the last one. (The vertex stays;
    // its face may be replaced.)
    Vertex last{};
    for (const std::vector<std::uint32_t>& outline : outlines) {
      std::vector<Vertex> vertices;
      vertices.reserve(outline.size());
      for (const std::uint32_t i : outline) {
        const Vertex v =
            triangulation_.insert(typename Kernel::Point_2(out_.points[i].x, out_.points[i].y),
                                  last == Vertex{} ? Face{} : last->face());
        if (v->info().index == unset) v->info().index = i;  // else a place seen before
        last = v;
        vertices.push_back(v);
      }
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vertex a = vertices[i], b = vertices[(i + 1) % vertices.size()];
        if (a != b) triangulation_.insert_constraint(a, b);
        if (triangulation_.number_of_vertices() > max_vertices)
          throw Error("", "outlines cross more than " + std::to_string(max_crossings_a_point) +
                              " times a point");
      }
    }
  }

  // Crossings are the vertices that no input point has named.
  void add_crossings() {
    for (const Vertex v : triangulation_.finite_vertex_handles()) {
      if (v->info().index != unset) continue;
      out_.crossing = true;
      v->info().index = static_cast<std::uint32_t>(out_.points.size());
      out_.points.push_back(to_plan(v->point()));
    }
  }

  void mark_sides() {
    std::vector<Face> open{triangulation_.infinite_face()};
    open.back()->info().side = Side::outside;
    while (!open.empty()) {
      const Face face = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face next = face->neighbor(i);
        if (next->info().side != Side::unknown) continue;
        Side side = face->info().side;
        if (face->is_constrained(i)) {
          const auto enclosing = triangulation_.number_of_enclosing_constraints(
              face->vertex(Triangulation::ccw(i)), face->vertex(Triangulation::cw(i)));
          if (enclosing % 2 == 1) side = side == Side::inside ? Side::outside : Side::inside;
        }
        next->info().side = side;
        open.push_back(next);
      }
    }
  }

  Triangulation triangulation_;
  FlatTriangulation out_;
};

}  // namespace

FlatTriangulation triangulate_flat(std::span<const glm::dvec2> points,
                                   std::span<const std::vector<std::uint32_t>> outlines) {
  using Uncrossed = Flattener<UncrossedOutlines>;
  try {
    return Uncrossed(points).run(outlines);
  } catch (const Uncrossed::Triangulation::Intersection_of_constraints_exception&) {
    return Flattener<CrossedOutlines>(points).run(outlines);
  }
}

}  // namespace nightcity::mesh
