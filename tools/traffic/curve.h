// Smooth curves to drive along: plan lines with directions, and curves over them with heights.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace nightcity::traffic {

/// A point of a plan line and the unit direction there. Two points are joined by a cubic Hermite
/// arc.
struct PlanPoint {
  glm::dvec2 point, along;
};
using PlanLine = std::vector<PlanPoint>;

/// Returns the angle from one direction to another, radians, greater than 0 to the left.
double angle_between(const glm::dvec2& a, const glm::dvec2& b);

double length_of(const PlanLine& line);

/// Returns the polyline with its corners rounded by parabolas that deviate from it by at most
/// `deviation_m`. Its points are a few metres apart, closer where it bends. Needs two distinct
/// points.
PlanLine round_corners(std::span<const glm::dvec2> line, double deviation_m);

/// Returns the part from `from_m` to `to_m` along the line.
PlanLine trimmed(const PlanLine& line, double from_m, double to_m);

/// Returns the line shifted by `right_m` to the right (negative: to the left). Where a bend is
/// tighter than the shift, the inner line is cut short instead of turning back.
PlanLine shifted(const PlanLine& line, double right_m);

/// Returns one smooth turn from a place and direction to another: a cubic arc, which is nearly a
/// circle for the turns of junctions.
PlanLine turn_between(const PlanPoint& from, const PlanPoint& to);

/// A plan line with heights, by arc length in plan.
class Curve {
 public:
  struct Sample {
    glm::dvec3 point;  // E, N, H
    glm::dvec3 along;  // d point / d s: its plan part is unit
    double s;          // arc length in plan from the start, m
    double curvature;  // 1 / m, greater than 0 to the left
  };
  struct Height {
    double height_m, slope;
  };

  Curve() = default;
  /// `heights`: one for each point of `line`.
  Curve(const PlanLine& line, std::span<const Height> heights);

  double length() const { return samples_.back().s; }
  const std::vector<Sample>& samples() const { return samples_; }
  /// Returns point and direction at `s`, which is clamped to the curve. Both are continuous.
  struct Place {
    glm::dvec3 point, along;
  };
  Place at(double s) const;
  /// Returns the index of the sample before `s`, at most the last but one.
  std::size_t before(double s) const;

 private:
  std::vector<Sample> samples_;
};

}  // namespace nightcity::traffic
