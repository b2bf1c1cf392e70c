#include "tools/traffic/curve.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nightcity::traffic {
namespace {

using glm::dvec2;

constexpr double straight_step_m = 4;  // between points, so that the curve follows hills
constexpr double bend_step_radians =
    0.1;  // 6 degrees: Hermite arcs keep a circle to 1e-5 of its radius

double cross(const dvec2& a, const dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Appends points on the straight line from the last point, which must exist, to `to`,
/// without `to` itself.
void add_straight(PlanLine& line, const dvec2& to) {
  const dvec2 from = line.back().point;
  const double length = glm::distance(from, to);
  if (length < 1e-6) return;
  const dvec2 along = (to - from) / length;
  const int steps = static_cast<int>(std::ceil(length / straight_step_m));
  for (int k = 1; k < steps; ++k) line.push_back({from + along * (length * k / steps), along});
}

void add_point(PlanLine& line, const PlanPoint& point) {
  if (!line.empty() && glm::distance(line.back().point, point.point) < 1e-3) return;
  line.push_back(point);
}

}  // namespace

double angle_between(const dvec2& a, const dvec2& b) {
  return std::atan2(cross(a, b), glm::dot(a, b));
}

double length_of(const PlanLine& line) {
  double sum = 0;
  for (std::size_t n = 1; n < line.size(); ++n)
    sum += glm::distance(line[n - 1].point, line[n].point);
  return sum;
}

PlanLine round_corners(std::span<const dvec2> line, double deviation_m) {
  std::vector<dvec2> points;
  for (const dvec2& p : line)
    if (points.empty() || glm::distance(points.back(), p) > 0.05) points.push_back(p);
  if (points.size() < 2) points = {line.front(), line.back()};
  PlanLine result;
  result.push_back({points[0], glm::normalize(points[1] - points[0])});
  for (std::size_t n = 1; n + 1 < points.size(); ++n) {
    const dvec2 in = points[n] - points[n - 1], out = points[n + 1] - points[n];
    const double in_m = glm::length(in), out_m = glm::length(out);
    const dvec2 u = in / in_m, v = out / out_m;
    const double turn = angle_between(u, v);
    if (std::abs(turn) < 0.002) {
      add_straight(result, points[n]);
      add_point(result, {points[n], glm::normalize(u + v)});
      continue;
    }
    // The parabola's middle lies halfway between the corner and the middle of its chord: cut *
    // sin(turn / 2) / 2.
    const double cut =
        std::min({0.49 * in_m, 0.49 * out_m, 2 * deviation_m / std::abs(std::sin(turn / 2)), 25.0});
    const dvec2 a = points[n] - u * cut, b = points[n] + v * cut;
    add_straight(result, a);
    const int steps = std::max(2, static_cast<int>(std::ceil(std::abs(turn) / bend_step_radians)));
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const dvec2 p = a * ((1 - t) * (1 - t)) + points[n] * (2 * t * (1 - t)) + b * (t * t);
      const dvec2 d = u * (1 - t) + v * t;
      add_point(result, {p, glm::length(d) > 1e-6 ? glm::normalize(d) : dvec2(-u.y, u.x)});
    }
  }
  add_straight(result, points.back());
  add_point(result, {points.back(), glm::normalize(points.back() - points[points.size() - 2])});
  return result;
}

PlanLine trimmed(const PlanLine& line, double from_m, double to_m) {
  PlanLine result;
  double s = 0;
  const auto between = [&](std::size_t n, double t) {
    return PlanPoint{glm::mix(line[n].point, line[n + 1].point, t),
                     glm::normalize(glm::mix(line[n].along, line[n + 1].along, t))};
  };
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    const double step = glm::distance(line[n].point, line[n + 1].point), end = s + step;
    if (end > from_m && s < to_m) {
      if (result.empty()) result.push_back(between(n, std::clamp((from_m - s) / step, 0.0, 1.0)));
      if (end < to_m)
        add_point(result, line[n + 1]);
      else
        add_point(result, between(n, std::clamp((to_m - s) / step, 0.0, 1.0)));
    }
    s = end;
  }
  return result;
}

PlanLine shifted(const PlanLine& line, double right_m) {
  PlanLine result;
  const auto turns_back = [&](const PlanPoint& next) {
    const dvec2 step = next.point - result.back().point;
    return glm::dot(step, next.along) < 0.01 || glm::dot(step, result.back().along) < 0.01;
  };
  for (const PlanPoint& p : line) {
    const PlanPoint moved{p.point + dvec2(p.along.y, -p.along.x) * right_m, p.along};
    while (result.size() > 1 && turns_back(moved)) result.pop_back();
    if (result.empty() || !turns_back(moved)) add_point(result, moved);
  }
  // If a bend was cut short, the old directions no longer fit the points: take
  // them from the neighbours.
  for (std::size_t n = 0; result.size() > 1 && n < result.size(); ++n) {
    const std::size_t a = n == 0 ? 0 : n - 1, b = std::min(n + 1, result.size() - 1);
    const dvec2 in =
        glm::normalize(result[std::max<std::size_t>(n, 1)].point - result[a == n ? 0 : a].point);
    const dvec2 out = glm::normalize(result[b].point - result[b == n ? n - 1 : n].point);
    PlanPoint& here = result[n];
    const double off =
        std::max(std::abs(angle_between(here.along, in)), std::abs(angle_between(here.along, out)));
    if (off > bend_step_radians && glm::length(in + out) > 0.1)
      here.along = glm::normalize(in + out);
  }
  if (result.size() > 1) return result;
  // If nothing is left between the bends, go straight from end to end.
  const auto end = [&](const PlanPoint& p) {
    return p.point + dvec2(p.along.y, -p.along.x) * right_m;
  };
  const dvec2 from = end(line.front()), along = line.front().along;
  return {{from, along},
          {from + along * std::max(glm::dot(end(line.back()) - from, along), 0.1), along}};
}

PlanLine turn_between(const PlanPoint& from, const PlanPoint& to) {
  const double chord = glm::distance(from.point, to.point);
  const double turn = std::abs(angle_between(from.along, to.along));
  // For the arc of a circle, the handles are 4/3 tan(turn / 4) radii and the chord is 2
  // sin(turn / 2) radii.
  const double quarter = std::cos(std::min(turn, 3.0) / 4);
  const double handle = chord / (3 * quarter * quarter);
  const dvec2 p0 = from.point, p1 = p0 + from.along * handle, p3 = to.point,
              p2 = p3 - to.along * handle;
  const int steps = std::clamp(
      static_cast<int>(std::ceil(std::max(turn / bend_step_radians, chord / 1.5))), 2, 64);
  PlanLine result;
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps, r = 1 - t;
    const dvec2 p =
        p0 * (r * r * r) + p1 * (3 * r * r * t) + p2 * (3 * r * t * t) + p3 * (t * t * t);
    const dvec2 d = (p1 - p0) * (r * r) + (p2 - p1) * (2 * r * t) + (p3 - p2) * (t * t);
    add_point(result, {p, glm::length(d) > 1e-9 ? glm::normalize(d) : from.along});
  }
  result.front().along = from.along;
  result.back().along = to.along;
  return result;
}

Curve::Curve(const PlanLine& line, std::span<const Height> heights) {
  double s = 0;
  for (std::size_t n = 0; n < line.size(); ++n) {
    if (n > 0) {
      // A chord is shorter than its arc by 1 / 24 of the squared angle.
      const double turn = angle_between(line[n - 1].along, line[n].along);
      s += glm::distance(line[n - 1].point, line[n].point) * (1 + turn * turn / 24);
    }
    samples_.push_back(
        {{line[n].point, heights[n].height_m}, {line[n].along, heights[n].slope}, s, 0});
  }
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const std::size_t a = n == 0 ? 0 : n - 1, b = std::min(n + 1, samples_.size() - 1);
    const double step = samples_[b].s - samples_[a].s;
    samples_[n].curvature = step > 0 ? angle_between(line[a].along, line[b].along) / step : 0;
  }
}

std::size_t Curve::before(double s) const {
  const auto after =
      std::upper_bound(samples_.begin() + 1, samples_.end() - 1, s,
                       [](double value, const Sample& sample) { return value < sample.s; });
  return static_cast<std::size_t>(after - samples_.begin()) - 1;
}

Curve::Place Curve::at(double s) const {
  s = std::clamp(s, 0.0, length());
  const Sample &a = samples_[before(s)], &b = (&a)[1];
  const double step = b.s - a.s, x = (s - a.s) / step, x2 = x * x, x3 = x2 * x;
  return {a.point * (2 * x3 - 3 * x2 + 1) + a.along * ((x3 - 2 * x2 + x) * step) +
              b.point * (3 * x2 - 2 * x3) + b.along * ((x3 - x2) * step),
          (b.point - a.point) * ((6 * x - 6 * x2) / step) + a.along * (3 * x2 - 4 * x + 1) +
              b.along * (3 * x2 - 2 * x)};
}

}  // namespace nightcity::traffic
