// Constrained Delaunay triangulation of outlines that may cross. Constrained_triangulation_plus_2
// knows which outlines run along an edge. Crossing it changes for each of them whether a place is
// enclosed: a hole that shares an edge with the exterior changes both there. (Plain nesting depth
// gets that case wrong.)
#include "tools/mesh/constrained.h"

#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "formats/error.h"
#include "tools/mesh/constrained_delaunay.h"

namespace nightcity::mesh {
namespace {

constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();

struct VertexInfo {
  std::uint32_t index = unset;
};
struct FaceInfo {
  std::uint32_t enclosed_by = unset;  // number of a set of outlines
};

// The sets of outlines that enclose places, each with a number. Outlines are few and hardly nested,
// so there are few sets, and small ones.
class OutlineSets {
 public:
  static constexpr std::uint32_t none = 0;
  // n outlines around each other would make sets of n^2 / 2 numbers.
  static constexpr std::size_t max_nested = 100;

  OutlineSets() { add({}); }

  /// Returns the set with one outline added or, where it holds it, taken away.
  std::uint32_t toggle(std::uint32_t set, std::uint32_t outline) {
    const auto [known, is_new] = toggled_.try_emplace({set, outline}, unset);
    if (!is_new) return known->second;
    std::vector<std::uint32_t> outlines = sets_[set];
    const auto at = std::lower_bound(outlines.begin(), outlines.end(), outline);
    if (at != outlines.end() && *at == outline)
      outlines.erase(at);
    else
      outlines.insert(at, outline);
    if (outlines.size() > max_nested)
      throw Error("", "more than " + std::to_string(max_nested) + " outlines within each other");
    return known->second = add(std::move(outlines));
  }

  const std::vector<std::uint32_t>& outlines(std::uint32_t set) const { return sets_[set]; }

 private:
  std::uint32_t add(std::vector<std::uint32_t> outlines) {
    const auto number = static_cast<std::uint32_t>(sets_.size());
    const auto [known, is_new] = numbers_.try_emplace(outlines, number);
    if (is_new) sets_.push_back(std::move(outlines));
    return known->second;
  }

  std::vector<std::vector<std::uint32_t>> sets_;  // ascending
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> toggled_;
};

template <class Outlines>
class Flattener {
 public:
  Flattener(std::span<const glm::dvec2> points, std::size_t max_crossings_a_point)
      : max_crossings_a_point_(max_crossings_a_point) {
    out_.points.assign(points.begin(), points.end());
  }

  FlatTriangulation run(std::span<const std::vector<std::uint32_t>> outlines) {
    insert(outlines);
    out_.area_outside.resize(outlines.size());
    if (triangulation_.dimension() < 2) return std::move(out_);  // all on one line
    add_crossings();
    mark_enclosed();
    for (const Face face : triangulation_.finite_face_handles()) take(face);
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
    const std::size_t max_vertices = (1 + max_crossings_a_point_) * out_.points.size();
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
        if (a != b)
          outline_of_.emplace(triangulation_.insert_constraint(a, b).vl_ptr(),
                              static_cast<std::uint32_t>(&outline - outlines.data()));
        if (triangulation_.number_of_vertices() > max_vertices)
          throw Error("", "outlines cross more than " + std::to_string(max_crossings_a_point_) +
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

  void mark_enclosed() {
    std::vector<Face> open{triangulation_.infinite_face()};
    open.back()->info().enclosed_by = OutlineSets::none;
    while (!open.empty()) {
      const Face face = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face next = face->neighbor(i);
        if (next->info().enclosed_by != unset) continue;
        std::uint32_t set = face->info().enclosed_by;
        if (face->is_constrained(i)) {
          const Vertex a = face->vertex(Triangulation::ccw(i)),
                       b = face->vertex(Triangulation::cw(i));
          for (auto along = triangulation_.contexts_begin(a, b);
               along != triangulation_.contexts_end(a, b); ++along)
            set = sets_.toggle(set, outline_of_.at(along->id().vl_ptr()));
        }
        next->info().enclosed_by = set;
        open.push_back(next);
      }
    }
  }

  void take(const Face& face) {
    const std::vector<std::uint32_t>& enclosing = sets_.outlines(face->info().enclosed_by);
    if (enclosing.empty()) return;
    const std::array<std::uint32_t, 3> corners{face->vertex(0)->info().index,
                                               face->vertex(1)->info().index,
                                               face->vertex(2)->info().index};
    if (enclosing.front() != 0) {  // in holes, but not in the exterior
      const glm::dvec2 a = out_.points[corners[0]], b = out_.points[corners[1]] - a,
                       c = out_.points[corners[2]] - a;
      for (const std::uint32_t hole : enclosing)
        out_.area_outside[hole] += (b.x * c.y - b.y * c.x) / 2;
    } else if (enclosing.size() == 1) {
      out_.triangles.push_back(corners);
    }
  }

  std::size_t max_crossings_a_point_;
  Triangulation triangulation_;
  FlatTriangulation out_;
  OutlineSets sets_;
  std::unordered_map<const void*, std::uint32_t> outline_of_;  // by constraint
};

}  // namespace

FlatTriangulation triangulate_flat(std::span<const glm::dvec2> points,
                                   std::span<const std::vector<std::uint32_t>> outlines,
                                   std::size_t max_crossings_a_point) {
  using Uncrossed = Flattener<UncrossedOutlines>;
  try {
    return Uncrossed(points, max_crossings_a_point).run(outlines);
  } catch (const Uncrossed::Triangulation::Intersection_of_constraints_exception&) {
    return Flattener<CrossedOutlines>(points, max_crossings_a_point).run(outlines);
  }
}

}  // namespace nightcity::mesh
