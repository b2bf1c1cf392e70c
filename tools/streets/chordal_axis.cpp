#include "tools/streets/chordal_axis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/mesh/constrained_delaunay.h"

namespace nightcity::streets {
namespace {

struct StreetFace {
  bool seen = false, inside = false, walked = false;
  std::size_t node = no_node;
};

using Kernel = mesh::PlaneKernel;
using Delaunay = mesh::ConstrainedDelaunay<StreetFace>;
using Face = Delaunay::Face_handle;
using Vertex = Delaunay::Vertex_handle;

class AxisMaker {
 public:
  AxisMaker(std::span<const OutlineEdge> outline, double step_m) : origin_(outline.front().first) {
    Face hint{};
    for (const auto& [from, to] : outline) {
      const glm::dvec2 a = from - origin_, b = to - origin_;
      const int parts = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / step_m)));
      Vertex last{};
      for (int k = 0; k <= parts; ++k) {
        // The points do not depend on the direction of the edge, and its ends are exact.
        const glm::dvec2 p = k == 0       ? a
                             : k == parts ? b
                                          : a + (b - a) * (static_cast<double>(k) / parts);
        const Vertex v = triangulation_.insert(Kernel::Point_2(p.x, p.y), hint);
        if (k > 0 && v != last) triangulation_.insert_constraint(last, v);
        last = v;
        hint = v->face();
      }
    }
  }

  Axis run() {
    if (triangulation_.dimension() < 2) return {};
    mark_inside();
    for (const Face face : triangulation_.finite_face_handles())
      if (face->info().inside) add_node(face);
    for (const Face face : triangulation_.finite_face_handles())
      if (face->info().node != no_node)
        for (int i = 0; i < 3; ++i)
          if (is_chord(face, i)) walk(face, i);
    // Chords that no walk has reached form rings.
    for (const Face face : triangulation_.finite_face_handles())
      if (face->info().inside && face->info().node == no_node && !face->info().walked)
        walk_ring(face);
    for (Axis::Node& node : axis_.nodes) {
      node.place += origin_;
      for (glm::dvec2& tip : node.tips) tip += origin_;
    }
    for (Axis::Branch& branch : axis_.branches)
      for (glm::dvec2& p : branch.line) p += origin_;
    return std::move(axis_);
  }

 private:
  static glm::dvec2 plan(const Vertex& v) { return {v->point().x(), v->point().y()}; }

  static glm::dvec2 middle(const Face& face, int i) {
    return (plan(face->vertex(Delaunay::ccw(i))) + plan(face->vertex(Delaunay::cw(i)))) / 2.0;
  }

  void mark_inside() {
    std::vector<Face> open{triangulation_.infinite_face()};
    open.back()->info().seen = true;
    while (!open.empty()) {
      const Face face = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face next = face->neighbor(i);
        if (next->info().seen) continue;
        next->info().seen = true;
        next->info().inside = face->info().inside != face->is_constrained(i);
        open.push_back(next);
      }
    }
  }

  static bool is_chord(const Face& face, int i) { return !face->is_constrained(i); }

  static int chords(const Face& face) {
    int count = 0;
    for (int i = 0; i < 3; ++i) count += is_chord(face, i);
    return count;
  }

  void add_node(const Face& face) {
    const int count = chords(face);
    if (count != 1 && count != 3) return;
    Axis::Node node;
    const glm::dvec2 a = plan(face->vertex(0)), b = plan(face->vertex(1)),
                     c = plan(face->vertex(2));
    if (count == 3) {
      node.place = (a + b + c) / 3.0;
      node.reach_m = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    } else {
      for (int i = 0; i < 3; ++i)
        if (is_chord(face, i)) {
          node.place = middle(face, i);
          node.tips.push_back(plan(face->vertex(i)));
        }
    }
    face->info().node = axis_.nodes.size();
    axis_.nodes.push_back(std::move(node));
  }

  /// Returns the width of the outline at a face with one edge on it: from that edge to the opposite
  /// corner.
  static double width_at(const Face& face) {
    for (int i = 0; i < 3; ++i)
      if (!is_chord(face, i)) {
        const glm::dvec2 a = plan(face->vertex(Delaunay::ccw(i))),
                         b = plan(face->vertex(Delaunay::cw(i))), c = plan(face->vertex(i));
        const glm::dvec2 edge = b - a, to = c - a;
        const double length = glm::length(edge);
        return length > 0 ? std::abs(edge.x * to.y - edge.y * to.x) / length : 0;
      }
    return 0;
  }

  static void add_point(Axis::Branch& branch, const glm::dvec2& p, double width) {
    if (!branch.line.empty()) branch.width_m.push_back(width);
    branch.line.push_back(p);
  }

  /// Walks from face to face through chords, starting through chord `i` of `face`, until it
  /// reaches a node.
  Face follow(Face face, int i, Axis::Branch& branch) {
    for (;;) {
      const Face next = face->neighbor(i);
      if (next->info().node != no_node || next->info().walked) return next;
      next->info().walked = true;
      const int back = next->index(face);
      for (int k = 0; k < 3; ++k)
        if (k != back && is_chord(next, k)) {
          add_point(branch, middle(next, k), width_at(next));
          face = next;
          i = k;
          break;
        }
    }
  }

  void walk(const Face& from, int i) {
    const Face next = from->neighbor(i);
    const std::size_t start = from->info().node;
    // Each branch is walked from one end; between two neighbouring nodes, from the one with
    // the lower number.
    if (next->info().node != no_node) {
      if (next->info().node <= start) return;
    } else if (next->info().walked) {
      return;
    }
    Axis::Branch branch;
    branch.from = start;
    add_point(branch, axis_.nodes[start].place, 0);
    if (chords(from) == 3) add_point(branch, middle(from, i), 0);
    const Face last = follow(from, i, branch);
    branch.to = last->info().node;
    if (chords(last) == 3) add_point(branch, axis_.nodes[branch.to].place, 0);
    axis_.branches.push_back(std::move(branch));
  }

  void walk_ring(const Face& face) {
    Axis::Branch branch;
    for (int i = 0; i < 3; ++i)
      if (is_chord(face, i)) {
        branch.from = branch.to = axis_.nodes.size();
        add_point(branch, middle(face, i), 0);
        axis_.nodes.push_back({branch.line.front(), 0, {}});
        follow(face, i, branch);
        break;
      }
    if (branch.line.size() > 3) axis_.branches.push_back(std::move(branch));
  }

  Delaunay triangulation_;
  glm::dvec2 origin_;
  Axis axis_;
};

}  // namespace

Axis chordal_axis(std::span<const OutlineEdge> outline, double step_m) {
  if (outline.empty()) return {};
  return AxisMaker(outline, step_m).run();
}

}  // namespace nightcity::streets
