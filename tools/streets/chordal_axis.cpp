#include "tools/streets/chordal_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "formats/error.h"
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

// Edges of more pieces are inserted from the coarse to the fine.
constexpr std::size_t longest_in_order = 256;

std::size_t count_parts(const glm::dvec2& a, const glm::dvec2& b, double step_m) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(glm::distance(a, b) / step_m)));
}

class AxisMaker {
 public:
  AxisMaker(std::span<const OutlineEdge> outline, double step_m) : origin_(outline.front().first) {
    for (const auto& [from, to] : outline) insert(from - origin_, to - origin_, step_m);
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
  // The points between do not depend on the direction of the edge, and its ends are exact.
  void insert(const glm::dvec2& a, const glm::dvec2& b, double step_m) {
    const std::size_t parts = count_parts(a, b, step_m);
    std::vector<Vertex> vertices(parts + 1);
    for (const std::size_t k : list_insertions(parts)) {
      const glm::dvec2 p =
          k == 0       ? a
          : k == parts ? b
                       : a + (b - a) * (static_cast<double>(k) / static_cast<double>(parts));
      vertices[k] = triangulation_.insert(Kernel::Point_2(p.x, p.y), hint_);
      hint_ = vertices[k]->face();
      if (parts <= longest_in_order && k > 0) join(vertices[k - 1], vertices[k]);
    }
    for (std::size_t k = 1; parts > longest_in_order && k <= parts; ++k)
      join(vertices[k - 1], vertices[k]);
  }

  void join(const Vertex& from, const Vertex& to) {
    if (from == to) return;
    triangulation_.insert_constraint(from, to);
    hint_ = to->face();
  }

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
  Face hint_{};  // near the last point
  glm::dvec2 origin_;
  Axis axis_;
};

}  // namespace

std::vector<std::size_t> list_insertions(std::size_t parts) {
  std::vector<std::size_t> order;
  order.reserve(parts + 1);
  if (parts <= longest_in_order) {
    for (std::size_t k = 0; k <= parts; ++k) order.push_back(k);
    return order;
  }
  order = {0, parts};
  std::size_t stride = std::bit_floor(parts - 1);
  for (; stride > 0; stride /= 2)
    for (std::size_t k = stride; k < parts; k += 2 * stride) order.push_back(k);
  return order;
}

Axis chordal_axis(std::span<const OutlineEdge> outline, double step_m, int max_points) {
  if (outline.empty()) return {};
  std::size_t points = 0;
  for (const auto& [from, to] : outline) {
    points += count_parts(from, to, step_m);
    if (points > static_cast<std::size_t>(max_points))
      throw Error("", "the outlines of the model's roads have more than " +
                          std::to_string(max_points) + " points " + fmt::format("{:g}", step_m) +
                          " m apart, from which streets are found: raise [city] max_road_points "
                          "in a recipe, or give a map with streets, [osm] files");
  }
  return AxisMaker(outline, step_m).run();
}

}  // namespace nightcity::streets
