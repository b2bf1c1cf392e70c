#include "tools/barriers/barrier_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <set>
#include <utility>

namespace nightcity::barriers {
namespace {

// A bend is mitred up to a corner of 60 degrees, beyond which its tip is cut off (as for streets).
constexpr double mitre_limit = 2;

using Line = std::vector<glm::dvec3>;

glm::dvec3 raised(const glm::dvec3& p, double by_m) {
  return {p.x, p.y, p.z + by_m};
}

// Adds the quad a, b, c, d, counter-clockwise.
void add_quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
              std::vector<Corners>& out) {
  out.push_back({a, b, c});
  out.push_back({a, c, d});
}

// Adds a wall that looks to the right of the way from a to b.
void add_side(const glm::dvec3& a, const glm::dvec3& b, double low_m, double high_m,
              std::vector<Corners>& out) {
  add_quad(raised(a, low_m), raised(b, low_m), raised(b, high_m), raised(a, high_m), out);
}

glm::dvec2 direction(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec2 along = glm::dvec2(b) - glm::dvec2(a);
  const double length = glm::length(along);
  return length > 0 ? along / length : glm::dvec2(0);
}

glm::dvec2 left_of(const glm::dvec2& along) {
  return {-along.y, along.x};
}

// Returns the way to the left at a point between two directions, as long as makes a strip of unit
// width there.
glm::dvec2 find_mitre(const glm::dvec2& before, const glm::dvec2& after) {
  if (before == glm::dvec2(0)) return left_of(after);
  if (after == glm::dvec2(0)) return left_of(before);
  const glm::dvec2 sum = left_of(before) + left_of(after);
  const double length = glm::length(sum);
  if (length < 1e-6) return left_of(before);  // it turns back
  const glm::dvec2 middle = sum / length;
  return middle * std::min(mitre_limit, 1 / glm::dot(middle, left_of(before)));
}

// Returns the points moved to the left by `by_m`.
Line move_left(const Line& line, bool closed, double by_m) {
  const std::size_t n = line.size();
  Line out;
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0 && !closed, last = i + 1 == n && !closed;
    const glm::dvec2 before = first ? glm::dvec2(0) : direction(line[(i + n - 1) % n], line[i]),
                     after = last ? glm::dvec2(0) : direction(line[i], line[(i + 1) % n]);
    out.push_back(line[i] + glm::dvec3(find_mitre(before, after) * by_m, 0));
  }
  return out;
}

// Moves the ends of both sides along the first and the last segment.
void cut_ends(const BarrierLine& barrier, Line& left, Line& right) {
  const Line& line = barrier.points;
  const auto outward = [](const glm::dvec3& before, const glm::dvec3& end) {
    const double length = glm::distance(glm::dvec2(before), glm::dvec2(end));
    return length > 0 ? (end - before) / length : glm::dvec3(0);
  };
  const glm::dvec3 back = outward(line[1], line[0]),
                   ahead = outward(line[line.size() - 2], line.back());
  // Whoever looks back has the left side of the line on the right.
  left.front() += back * barrier.ends[0].right_m;
  right.front() += back * barrier.ends[0].left_m;
  left.back() += ahead * barrier.ends[1].left_m;
  right.back() += ahead * barrier.ends[1].right_m;
}

void make_box(const BarrierLine& barrier, std::vector<Corners>& out) {
  const std::size_t n = barrier.points.size(), sides = barrier.closed ? n : n - 1;
  const double half_m = barrier.kind.width_m / 2, top_m = barrier.kind.height_m;
  Line left = move_left(barrier.points, barrier.closed, half_m),
       right = move_left(barrier.points, barrier.closed, -half_m);
  if (!barrier.closed) cut_ends(barrier, left, right);
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t j = (i + 1) % n;
    add_side(right[i], right[j], -foot_m, top_m, out);
    add_side(left[j], left[i], -foot_m, top_m, out);
    add_quad(raised(right[i], top_m), raised(right[j], top_m), raised(left[j], top_m),
             raised(left[i], top_m), out);
  }
  if (barrier.closed) return;
  add_side(left.front(), right.front(), -foot_m, top_m, out);
  add_side(right.back(), left.back(), -foot_m, top_m, out);
}

// Adds posts evenly along a line and returns the share of it that they cover.
double add_posts(const BarrierLine& barrier, double length_m, std::vector<Corners>& out) {
  const Line behind = move_left(barrier.points, barrier.closed, post_behind_m);
  const std::size_t n = barrier.points.size(), sides = barrier.closed ? n : n - 1;
  const double count = std::max(1.0, std::round(length_m / post_spacing_m)),
               spacing_m = length_m / count;
  double next_m = spacing_m / 2;
  for (std::size_t i = 0; i < sides; ++i) {
    const glm::dvec3 &a = behind[i], &b = behind[(i + 1) % n];
    const double side_m = glm::distance(barrier.points[i], barrier.points[(i + 1) % n]);
    const glm::dvec3 half(direction(a, b) * (post_m / 2), 0);
    for (; next_m <= side_m; next_m += spacing_m) {
      const glm::dvec3 post = a + (b - a) * (next_m / side_m);
      add_side(post - half, post + half, -foot_m, barrier.kind.height_m, out);
    }
    next_m -= side_m;
  }
  return std::min(1.0, count * post_m / length_m);
}

void make_sheet(const BarrierLine& barrier, std::vector<Corners>& out) {
  const std::size_t n = barrier.points.size(), sides = barrier.closed ? n : n - 1;
  const BarrierKind& kind = barrier.kind;
  const auto add_rail = [&](double low_m, double high_m) {
    for (std::size_t i = 0; i < sides; ++i)
      add_side(barrier.points[i], barrier.points[(i + 1) % n], low_m, high_m, out);
  };
  if (kind.gap <= 0) return add_rail(-foot_m, kind.height_m);
  double length_m = 0;
  for (std::size_t i = 0; i < sides; ++i)
    length_m += glm::distance(barrier.points[i], barrier.points[(i + 1) % n]);
  if (!(length_m > 0)) return;
  const double posts = add_posts(barrier, length_m, out);
  // Light that passes both: gap = (1 - rails) (1 - posts).
  const double rails = posts < 1 ? 1 - std::min(1.0, kind.gap / (1 - posts)) : 0;
  const double count =
      kind.rails > 0 ? kind.rails : std::max(1.0, std::round(kind.height_m / rail_spacing_m));
  const double spacing_m = kind.height_m / count;
  for (double rail = 1; rail <= count && rails > 0; ++rail)
    add_rail((rail - rails) * spacing_m, rail * spacing_m);
}

}  // namespace

std::vector<Corners> make_shape(const BarrierLine& line) {
  std::vector<Corners> out;
  if (line.points.size() < 2) return out;
  if (line.kind.width_m > 0)
    make_box(line, out);
  else
    make_sheet(line, out);
  return out;
}

std::vector<Corners> make_shape(const BarrierArea& area) {
  std::vector<Corners> out;
  const double top_m = area.kind.height_m;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::set<Edge> edges;  // of triangles, in their direction
  for (const auto& t : area.triangles) {
    out.push_back({raised(area.points[t[0]], top_m), raised(area.points[t[1]], top_m),
                   raised(area.points[t[2]], top_m)});
    for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  }
  for (const Edge& edge : edges)
    if (!edges.contains({edge.second, edge.first}))
      add_side(area.points[edge.first], area.points[edge.second], -foot_m, top_m, out);
  return out;
}

}  // namespace nightcity::barriers
