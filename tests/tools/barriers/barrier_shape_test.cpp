#include "tools/barriers/barrier_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace nightcity::barriers {
namespace {

constexpr double h = 2, w = 0.5;
const BarrierKind wall{"wall", h, w, BarrierMaterial::brick};

BarrierKind fence(double gap, double height_m = 1.25) {
  return {"fence", height_m, 0, BarrierMaterial::painted_metal, gap};
}

// Area of the surfaces that `wants` accepts by their normals, m2.
template <class Wants>
double area_of(const std::vector<Corners>& surface, const Wants& wants) {
  double area = 0;
  for (const Corners& c : surface) {
    const glm::dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    if (wants(n)) area += glm::length(n) / 2;
  }
  return area;
}

bool looks_up(const glm::dvec3& n) {
  return n.z > 0.9 * glm::length(n);
}
bool looks_aside(const glm::dvec3& n) {
  return std::abs(n.z) < 1e-9;
}

// The volume above the plane of the wall's feet, by the divergence theorem: the missing floor lies
// in that plane and adds nothing.
double volume_of(const std::vector<Corners>& surface) {
  double volume = 0;
  for (const Corners& c : surface)
    volume +=
        glm::dot(c[0] + glm::dvec3(0, 0, foot_m),
                 glm::cross(c[1] + glm::dvec3(0, 0, foot_m), c[2] + glm::dvec3(0, 0, foot_m))) /
        6;
  return volume;
}

TEST(BarrierShape, AStraightWallIsABox) {
  const auto surface = make_shape(BarrierLine{wall, {{0, 0, 0}, {4, 0, 0}, {10, 0, 0}}});
  EXPECT_NEAR(area_of(surface, looks_up), 10 * w, 1e-9);
  EXPECT_NEAR(area_of(surface, looks_aside), (2 * 10 + 2 * w) * (h + foot_m), 1e-9);
  EXPECT_NEAR(volume_of(surface), 10 * w * (h + foot_m), 1e-9);
}

TEST(BarrierShape, BendsAreMitred) {
  // Round a square of 8 m: between squares of 8.5 and 7.5 m, whichever way it is drawn.
  std::vector<glm::dvec3> ring{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
  for (int turn = 0; turn < 2; ++turn) {
    const auto surface = make_shape(BarrierLine{wall, ring, true});
    EXPECT_NEAR(area_of(surface, looks_up), 8.5 * 8.5 - 7.5 * 7.5, 1e-9);
    EXPECT_NEAR(volume_of(surface), (8.5 * 8.5 - 7.5 * 7.5) * (h + foot_m), 1e-9);
    std::reverse(ring.begin(), ring.end());
  }
}

TEST(BarrierShape, SharpBendsAndTurnsStayNearTheLine) {
  for (const double angle : {3.0, 3.14, 3.14159265358979})
    for (const Corners& c : make_shape(BarrierLine{
             wall, {{0, 0, 0}, {10, 0, 0}, {10 + 10 * std::cos(angle), 10 * std::sin(angle), 0}}}))
      for (const glm::dvec3& p : c) {
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
        EXPECT_LE(p.x, 10 + 2 * w / 2 + 1e-9);
      }
}

TEST(BarrierShape, WallsFollowTheGround) {
  for (const Corners& c : make_shape(BarrierLine{wall, {{0, 0, 5}, {10, 0, 8}}}))
    for (const glm::dvec3& p : c) {
      const double above = p.z - (5 + 3 * p.x / 10);
      EXPECT_TRUE(std::abs(above + foot_m) < 1e-9 || std::abs(above - h) < 1e-9);
    }
}

// The share of a sheet's face that is free, by a grid of rays that come aslant. Its rails lie in
// one plane and its posts behind it.
double measure_gap(const BarrierLine& line, const glm::dvec3& direction) {
  const auto surface = make_shape(line);
  int passed = 0, all = 0;
  for (double x = 20.0037; x < 30; x += 0.0197)
    for (double z = 0.0011; z < line.kind.height_m; z += 0.0071, ++all) {
      bool blocked = false;
      for (const Corners& c : surface) {
        const double t = c[0].y / direction.y;
        const double px = x + direction.x * t, pz = z + direction.z * t;
        // A quad's triangles cover its rectangle: either holds the place.
        const glm::dvec2 p(px, pz), a(c[0].x, c[0].z), b(c[1].x, c[1].z), d(c[2].x, c[2].z);
        const auto side = [](const glm::dvec2& u, const glm::dvec2& v, const glm::dvec2& q) {
          return (v.x - u.x) * (q.y - u.y) - (v.y - u.y) * (q.x - u.x);
        };
        const double s0 = side(a, b, p), s1 = side(b, d, p), s2 = side(d, a, p);
        if ((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0)) {
          blocked = true;
          break;
        }
      }
      passed += !blocked;
    }
  return double(passed) / all;
}

TEST(BarrierShape, LightPassesAFenceAsItsGapSaysFromAnyDirection) {
  for (const double gap : {0.25, 0.8})
    for (const glm::dvec3& direction :
         {glm::dvec3(0, 1, 0), glm::dvec3(0.7, 1, 0), glm::dvec3(-2, 1, 0)}) {
      const BarrierLine line{fence(gap), {{0, 0, 0}, {50, 0, 0}}};
      EXPECT_NEAR(measure_gap(line, direction), gap, 0.01) << gap << ' ' << direction.x;
    }
}

TEST(BarrierShape, ARailsAreaIsWhatTheGapLeaves) {
  const BarrierLine line{fence(0.8), {{0, 0, 0}, {50, 0, 0}}};
  const double posts_m2 = 20 * post_m * (1.25 + foot_m);
  const double rails = 1 - 0.8 / (1 - 20 * post_m / 50);
  EXPECT_NEAR(area_of(make_shape(line), looks_aside), posts_m2 + rails * 50 * 1.25, 1e-9);
}

TEST(BarrierShape, AFenceWithoutGapsIsClosed) {
  const auto surface = make_shape(BarrierLine{fence(0), {{0, 0, 0}, {10, 0, 0}}});
  EXPECT_NEAR(area_of(surface, looks_aside), 10 * (1.25 + foot_m), 1e-9);
}

TEST(BarrierShape, AGuardRailLeavesItsFootOpen) {
  BarrierKind rail{"guard_rail", 0.75, 0, BarrierMaterial::steel, 1 - 0.31 / 0.75, 1};
  double lowest = 1;
  for (const Corners& c : make_shape(BarrierLine{rail, {{0, 0, 0}, {50, 0, 0}}}))
    if (std::abs(c[1].x - c[0].x) > 1)
      for (const glm::dvec3& p : c) lowest = std::min(lowest, p.z);
  EXPECT_NEAR(lowest, 0.75 - 0.31, 0.02);  // posts take their share
}

TEST(BarrierShape, AnAreaHasATopAndSides) {
  const BarrierArea area{
      wall, {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto surface = make_shape(area);
  EXPECT_NEAR(area_of(surface, looks_up), 6, 1e-9);
  EXPECT_NEAR(area_of(surface, looks_aside), 10 * (h + foot_m), 1e-9);
  EXPECT_NEAR(volume_of(surface), 6 * (h + foot_m), 1e-9);
}

TEST(BarrierShape, NothingComesOfNothing) {
  EXPECT_TRUE(make_shape(BarrierLine{wall, {}}).empty());
  EXPECT_TRUE(make_shape(BarrierLine{fence(0.5), {{1, 1, 1}}}).empty());
  for (const Corners& c : make_shape(BarrierLine{fence(0.5), {{1, 1, 1}, {1, 1, 1}}}))
    for (const glm::dvec3& p : c) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

}  // namespace
}  // namespace nightcity::barriers
