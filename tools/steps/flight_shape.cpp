#include "tools/steps/flight_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "tools/ground_cover/measured_line.h"

namespace nightcity::steps {
namespace {

// The two edges of a flight at a length along its line.
struct Edges {
  glm::dvec2 left, right;
};

// Adds the quad a, b, c, d, counter-clockwise.
void add_quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
              std::vector<Corners>& out) {
  out.push_back({a, b, c});
  out.push_back({a, c, d});
}

// Adds a wall that looks to the right of the way from a to b.
void add_wall(const glm::dvec2& a, const glm::dvec2& b, double low_m, double high_m,
              std::vector<Corners>& out) {
  if (!(high_m > low_m)) return;
  add_quad({a, low_m}, {b, low_m}, {b, high_m}, {a, high_m}, out);
}

class Shape {
 public:
  explicit Shape(const Flight& flight)
      : flight_(flight),
        along_(flight.line),
        strips_(ground_cover::make_strips(flight.line, -flight.width_m / 2, flight.width_m / 2)),
        tread_m_(along_.length_m() / static_cast<double>(flight.treads_m.size())) {}

  std::vector<Corners> make() {
    double below_m = flight_.ground_m.front() - foot_m;
    for (std::size_t n = 0; n < flight_.treads_m.size(); ++n) {
      const double from_m = static_cast<double>(n) * tread_m_, to_m = from_m + tread_m_;
      const Edges front = find(from_m);
      add_wall(front.left, front.right, below_m, flight_.treads_m[n], out_);
      add_tread(from_m, to_m, flight_.treads_m[n], flight_.ground_m[n] - foot_m);
      below_m = flight_.treads_m[n];
    }
    const Edges back = find(along_.length_m());
    add_wall(back.right, back.left, flight_.ground_m.back() - foot_m, below_m, out_);
    return std::move(out_);
  }

 private:
  // Edges at bends are mitred: between the corners of a segment they run in proportion.
  Edges find(double s, std::size_t segment) const {
    const double from_m = along_.at(segment), to_m = along_.at(segment + 1);
    const double share = to_m > from_m ? std::clamp((s - from_m) / (to_m - from_m), 0.0, 1.0) : 0;
    const std::vector<glm::dvec2>& strip = strips_[segment];
    return {glm::mix(strip[3], strip[2], share), glm::mix(strip[0], strip[1], share)};
  }
  std::size_t find_segment(double s) const {
    std::size_t segment = 0;
    while (segment + 1 < strips_.size() && along_.at(segment + 1) <= s) ++segment;
    return segment;
  }
  Edges find(double s) const { return find(s, find_segment(s)); }

  // A tread that goes round a bend has a piece on each side of it.
  void add_tread(double from_m, double to_m, double height_m, double low_m) {
    for (std::size_t segment = find_segment(from_m); segment < strips_.size(); ++segment) {
      const double begin_m = std::max(from_m, along_.at(segment)),
                   end_m = std::min(to_m, along_.at(segment + 1));
      if (begin_m >= end_m) break;
      const Edges a = find(begin_m, segment), b = find(end_m, segment);
      add_quad({a.right, height_m}, {b.right, height_m}, {b.left, height_m}, {a.left, height_m},
               out_);
      add_wall(a.right, b.right, low_m, height_m, out_);
      add_wall(b.left, a.left, low_m, height_m, out_);
    }
  }

  const Flight& flight_;
  ground_cover::MeasuredLine along_;
  std::vector<std::vector<glm::dvec2>> strips_;  // right, right, left, left of each segment
  double tread_m_;
  std::vector<Corners> out_;
};

}  // namespace

std::vector<Corners> make_shape(const Flight& flight) {
  if (flight.line.size() < 2 || flight.treads_m.empty()) return {};
  return Shape(flight).make();
}

}  // namespace nightcity::steps
