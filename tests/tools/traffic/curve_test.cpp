#include "tools/traffic/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace nightcity::traffic {
namespace {

using glm::dvec2;
using std::numbers::pi;

Curve flat(const PlanLine& line) {
  return Curve(line, std::vector<Curve::Height>(line.size(), {0, 0}));
}

/// Returns the greatest jump of direction, in degrees, and of place between neighbouring samples
/// of a curve.
double max_turn(const Curve& curve, double step) {
  double worst = 0;
  for (double s = 0; s + step <= curve.length(); s += step) {
    const glm::dvec3 a = glm::normalize(curve.at(s).along),
                     b = glm::normalize(curve.at(s + step).along);
    worst = std::max(worst, std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * 180 / pi);
  }
  return worst;
}

TEST(RoundCorners, StaysWithinTheDeviationAndTurnsSmoothly) {
  const std::vector<dvec2> line = {{0, 0}, {60, 0}, {60, 50}, {10, 90}};
  const Curve curve = flat(round_corners(line, 1.0));
  const auto distance_to_line = [&](const dvec2& p) {
    double best = 1e9;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      const dvec2 e = line[n + 1] - line[n];
      const double t = std::clamp(glm::dot(p - line[n], e) / glm::dot(e, e), 0.0, 1.0);
      best = std::min(best, glm::distance(p, line[n] + e * t));
    }
    return best;
  };
  double worst = 0;
  for (double s = 0; s <= curve.length(); s += 0.05)
    worst = std::max(worst, distance_to_line(dvec2(curve.at(s).point)));
  EXPECT_LE(worst, 1.01);
  EXPECT_GT(worst, 0.8);  // the bend uses most of what is allowed
  EXPECT_LT(max_turn(curve, 0.01), 1.0);
  EXPECT_NEAR(glm::distance(dvec2(curve.at(curve.length()).point), line.back()), 0, 1e-9);
}

TEST(Curve, ArcLengthOfACircleIsExact) {
  PlanLine circle;
  constexpr double radius = 12;
  for (int k = 0; k <= 60; ++k) {
    const double a = k * pi / 60;
    circle.push_back({dvec2(std::cos(a), std::sin(a)) * radius, {-std::sin(a), std::cos(a)}});
  }
  const Curve curve = flat(circle);
  EXPECT_NEAR(curve.length(), pi * radius, 1e-4);
  for (double s = 0.3; s < curve.length(); s += 0.7) {
    const Curve::Place place = curve.at(s);
    EXPECT_NEAR(glm::length(dvec2(place.point)), radius, 1e-4);
    EXPECT_NEAR(std::atan2(place.point.y, place.point.x) * radius, s, 1e-3);
    EXPECT_NEAR(glm::length(place.along), 1, 1e-4);
  }
  for (const Curve::Sample& sample : curve.samples())
    EXPECT_NEAR(sample.curvature, 1 / radius, 1e-6);
}

TEST(Shifted, KeepsItsDistanceAndDoesNotTurnBack) {
  const PlanLine middle = round_corners(std::vector<dvec2>{{0, 0}, {40, 0}, {40, 40}}, 1.0);
  for (const double right : {-4.0, -1.5, 1.5, 4.0}) {
    const PlanLine lane = shifted(middle, right);
    for (std::size_t n = 1; n < lane.size(); ++n)
      EXPECT_GT(glm::dot(lane[n].point - lane[n - 1].point, lane[n].along), 0) << right;
    for (const PlanPoint& p : lane) {
      double nearest = 1e9;
      for (std::size_t n = 0; n + 1 < middle.size(); ++n) {
        const dvec2 e = middle[n + 1].point - middle[n].point;
        const double t =
            std::clamp(glm::dot(p.point - middle[n].point, e) / glm::dot(e, e), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p.point, middle[n].point + e * t));
      }
      EXPECT_LE(nearest, std::abs(right) + 0.01);
    }
  }
}

TEST(TurnBetween, AQuarterTurnIsNearlyACircle) {
  const PlanLine turn = turn_between({{0, 0}, {1, 0}}, {{8, 8}, {0, 1}});
  for (const PlanPoint& p : turn) EXPECT_NEAR(glm::distance(p.point, dvec2(0, 8)), 8, 0.01);
  EXPECT_EQ(turn.front().along, dvec2(1, 0));
  EXPECT_EQ(turn.back().along, dvec2(0, 1));
}

TEST(Trimmed, CutsByLength) {
  const PlanLine line = round_corners(std::vector<dvec2>{{0, 0}, {100, 0}}, 1);
  const PlanLine part = trimmed(line, 13, 71.5);
  EXPECT_NEAR(length_of(part), 58.5, 1e-9);
  EXPECT_NEAR(part.front().point.x, 13, 1e-9);
}

TEST(Curve, BrokenLinesDoNoHarm) {
  for (const std::vector<dvec2>& line :
       {std::vector<dvec2>{{0, 0}, {10, 0}, {0, 0}}, std::vector<dvec2>{{0, 0}, {10, 0}, {0, 0.01}},
        std::vector<dvec2>{{0, 0}, {0.001, 0}, {5, 5}, {5, 5}, {5.001, 5}, {9, 0}}}) {
    const PlanLine rounded = round_corners(line, 1);
    for (const PlanPoint& p : rounded) {
      EXPECT_TRUE(std::isfinite(p.point.x + p.point.y + p.along.x + p.along.y));
      EXPECT_NEAR(glm::length(p.along), 1, 1e-9);
    }
    ASSERT_GT(rounded.size(), 1u);
    EXPECT_TRUE(std::isfinite(flat(rounded).length()));
  }
}

}  // namespace
}  // namespace nightcity::traffic
