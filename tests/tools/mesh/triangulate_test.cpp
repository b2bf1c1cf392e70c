#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tools/mesh/classify.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/polygon_plane.h"
#include "tools/mesh/triangle_mesh.h"
#include "tools/mesh/triangulate.h"

namespace nightcity::mesh {
namespace {

struct Result {
  TriangleMesh mesh;
  MeshReport report;
  glm::dvec3 vector{0};  // sum of the triangles' area vectors
  double area = 0;       // sum of their areas
};

Result run(std::vector<city::Polygon> polygons) {
  city::CityObject object;
  object.id = "object";
  object.polygons = std::move(polygons);
  Result r;
  r.mesh = triangulate(object, r.report);
  for (const MeshTriangle& t : r.mesh.triangles) {
    const glm::dvec3& a = r.mesh.positions.at(t.vertex[0]);
    const glm::dvec3 half = 0.5 * glm::cross(r.mesh.positions.at(t.vertex[1]) - a,
                                             r.mesh.positions.at(t.vertex[2]) - a);
    r.vector += half;
    r.area += glm::length(half);
  }
  return r;
}

city::Polygon polygon(city::Ring exterior, std::vector<city::Ring> interiors = {}) {
  city::Polygon p;
  p.exterior = std::move(exterior);
  p.interiors = std::move(interiors);
  return p;
}

city::Ring square(double x, double y, double side, double z = 0) {
  return {{x, y, z}, {x + side, y, z}, {x + side, y + side, z}, {x, y + side, z}};
}

city::Ring reversed(city::Ring ring) {
  return {ring.rbegin(), ring.rend()};
}

void expect_area(const Result& r, double area) {
  EXPECT_NEAR(r.area, area, 1e-6 * area);
  EXPECT_NEAR(glm::length(r.vector), area, 1e-6 * area);
}

TEST(Triangulate, TriangleAndConvexQuadNeedNoCgal) {
  const Result t = run({polygon({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}})});
  expect_area(t, 6);
  EXPECT_EQ(t.report.fast_path, 1u);
  const Result q = run({polygon(square(0, 0, 2))});
  expect_area(q, 4);
  EXPECT_EQ(q.report.fast_path, 1u);
  EXPECT_EQ(q.mesh.triangles.size(), 2u);
}

TEST(Triangulate, ConcaveQuadIsCutAlongItsInnerDiagonalWhereverItStarts) {
  const city::Ring dart{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};  // area 4
  for (std::size_t start = 0; start < 4; ++start) {
    city::Ring ring;
    for (std::size_t i = 0; i < 4; ++i) ring.push_back(dart[(start + i) % 4]);
    expect_area(run({polygon(ring)}), 4);
    expect_area(run({polygon(reversed(ring))}), 4);
  }
}

TEST(Triangulate, NormalsFollowTheRing) {
  EXPECT_GT(run({polygon(square(0, 0, 2))}).vector.z, 0);
  EXPECT_LT(run({polygon(reversed(square(0, 0, 2)))}).vector.z, 0);
  const city::Ring l_shape{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  EXPECT_NEAR(run({polygon(l_shape)}).vector.z, 5, 1e-9);
  EXPECT_NEAR(run({polygon(reversed(l_shape))}).vector.z, -5, 1e-9);
}

TEST(Triangulate, HoleIsSubtractedInEitherDirection) {
  expect_area(run({polygon(square(0, 0, 10), {square(4, 4, 2)})}), 96);
  expect_area(run({polygon(square(0, 0, 10), {reversed(square(4, 4, 2))})}), 96);
  expect_area(run({polygon(square(0, 0, 10), {square(1, 1, 2), square(6, 6, 3)})}), 87);
}

TEST(Triangulate, HoleThatSharesAnEdgeWithTheShellIsSubtracted) {
  const Result r = run({polygon(square(0, 0, 10), {square(4, 0, 2)})});
  expect_area(r, 96);
  EXPECT_EQ(r.report.self_intersecting, 0u);
  expect_area(run({polygon(square(0, 0, 10), {{{0, 5, 0}, {2, 4, 0}, {2, 6, 0}}})}),
              98);  // touches by a vertex
}

TEST(Triangulate, TwoHolesThatShareAnEdgeAreBothSubtracted) {
  expect_area(run({polygon(square(0, 0, 10), {square(2, 2, 2), square(4, 2, 2)})}), 92);
}

TEST(Triangulate, BowTieKeepsBothWingsAndIsCounted) {
  // Symmetric: its area vector is zero, and its two wings have 1 m2 each.
  const Result r = run({polygon({{0, 0, 5}, {2, 2, 5}, {2, 0, 5}, {0, 2, 5}})});
  EXPECT_NEAR(r.area, 2, 1e-9);
  EXPECT_EQ(r.report.self_intersecting, 1u);
  EXPECT_EQ(r.report.worst_self_intersecting, "object");
  for (const glm::dvec3& p : r.mesh.positions) EXPECT_NEAR(p.z, 5, 1e-9);
}

TEST(Triangulate, HoleHalfOutsideCutsOutItsInnerHalfAndIsCounted) {
  // 10 x 10 with a 2 x 2 hole half outside.
  const Result r = run({polygon(square(0, 0, 10), {square(9, 4, 2)})});
  expect_area(r, 98);
  EXPECT_EQ(r.report.holes_outside, 1u);
  EXPECT_NEAR(r.report.worst_hole_outside_m2, 2, 1e-9);
  EXPECT_EQ(r.report.worst_hole_outside, "object");
  EXPECT_EQ(r.report.self_intersecting, 0u);
}

TEST(Triangulate, HoleOutsideAddsNoSurfaceAndIsCounted) {
  for (const bool turned : {false, true}) {
    const city::Ring hole = turned ? reversed(square(20, 4, 4)) : square(20, 4, 4);
    const Result r = run({polygon(square(0, 0, 10), {hole, square(4, 4, 2)})});
    expect_area(r, 96);
    EXPECT_EQ(r.report.holes_outside, 1u);
    EXPECT_NEAR(r.report.worst_hole_outside_m2, 16, 1e-9);
    EXPECT_EQ(r.report.self_intersecting, 0u);
  }
}

TEST(Triangulate, HoleAroundItsExteriorLeavesNothing) {
  const Result r = run({polygon(square(0, 0, 10), {square(-1, -1, 12)})});
  EXPECT_EQ(r.mesh.triangles.size(), 0u);
  EXPECT_EQ(r.report.zero_area, 1u);
  EXPECT_NEAR(r.report.worst_hole_outside_m2, 144 - 100, 1e-9);
  const Result same = run({polygon(square(0, 0, 10), {square(0, 0, 10)})});
  EXPECT_EQ(same.report.zero_area, 1u);
  EXPECT_EQ(same.report.holes_outside, 0u);
}

TEST(Triangulate, PlaceInTwoHolesIsCutOutToo) {
  // Two 4 x 4 holes share 2 x 2; a third lies within the first.
  const Result r =
      run({polygon(square(0, 0, 10), {square(1, 1, 4), square(3, 3, 4), square(1.5, 1.5, 1)})});
  EXPECT_NEAR(r.area, 100 - 16 - 16 + 4, 1e-9);
  EXPECT_EQ(r.report.self_intersecting, 1u);  // the area differs from that of the rings
  EXPECT_EQ(r.report.holes_outside, 0u);
}

TEST(Triangulate, CollinearAndEmptyRingsAreDroppedAndCounted) {
  const Result r = run({polygon({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}),
                        polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), polygon({}),
                        polygon({{1, 2, 3}}), polygon({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}})});
  EXPECT_TRUE(r.mesh.triangles.empty());
  EXPECT_EQ(r.report.zero_area, 5u);
  EXPECT_EQ(r.report.polygons, 5u);
}

TEST(Triangulate, DuplicatesAndCollinearVerticesChangeNothing) {
  city::Ring ring{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                  {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  expect_area(run({polygon(ring)}), 4);
  expect_area(run({polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}})}),
              2);  // quad with a straight corner
}

TEST(Triangulate, SliverKeepsItsAreaFarFromTheOrigin) {
  // 1 mm by 30 m, standing upright at 10^7 m: 0.03 m2.
  const double e = 32500000, n = 5800000;
  const Result r =
      run({polygon({{e, n, 10}, {e + 30, n, 10}, {e + 30, n, 10.001}, {e, n, 10.001}})});
  EXPECT_NEAR(r.area, 30 * (10.001 - 10.0), 1e-6);
  EXPECT_EQ(r.report.zero_area, 0u);
}

TEST(Triangulate, LeaningPlaneAtLargeCoordinatesKeepsItsArea) {
  const glm::dvec3 origin{32500000.25, 5800000.5, 34}, u{3, 4, 0},
      v{-4, 3, 12};  // |u| 5, |v| 13, square to each other
  const auto at = [&](double a, double b) { return origin + a * u + b * v; };
  const Result r = run({polygon({at(0, 0), at(4, 0), at(4, 1), at(2, 1), at(2, 3), at(0, 3)},
                                {{at(0.5, 0.25), at(1.5, 0.25), at(1.5, 0.75), at(0.5, 0.75)}})});
  expect_area(r, (4 * 1 + 2 * 2 - 0.5) * 65);
}

TEST(Triangulate, OffPlaneRingIsCountedWithItsDistanceAndKeepsItsAreaVector) {
  city::Ring ring{{0, 0, 0}, {10, 0, 0.2}, {10, 10, 0}, {5, 12, 0.1}, {0, 10, 0.2}};
  city::Polygon p = polygon(ring);
  p.id = "bent";
  const Result r = run({p});
  EXPECT_EQ(r.report.non_planar, 1u);
  EXPECT_EQ(r.report.worst_non_planar, "bent");
  EXPECT_GT(r.report.worst_non_planar_m, 0.05);
  EXPECT_LT(glm::distance(r.vector, city::area_vector(ring)), 1e-9 * r.area);
}

TEST(Triangulate, NotFiniteIsDroppedAndCountedAndNothingElseIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               inf = std::numeric_limits<double>::infinity();
  const Result r =
      run({polygon({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}),
           polygon(square(0, 0, 2), {{{0, 0, inf}, {1, 0, 0}, {0, 1, 0}}}),
           polygon({{0, 0, 0}, {1e300, 0, 0}, {0, 1e300, 0}}), polygon(square(0, 0, 2))});
  EXPECT_EQ(r.report.not_finite, 3u);
  expect_area(r, 4);
  EXPECT_EQ(r.mesh.triangles.front().polygon, 3u);
}

TEST(Triangulate, RandomStarsKeepTheirAreaAndTurnTheRightWay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(1, 10);
  for (int n = 5; n < 200; n += 7) {
    city::Ring ring;
    for (int i = 0; i < n; ++i) {
      const double r = radius(random), a = 2 * M_PI * i / n;
      ring.push_back({450000 + r * std::cos(a), 5500000 + r * std::sin(a), 30});
    }
    const Result r = run({polygon(ring)});
    expect_area(r, glm::length(city::area_vector(ring)));
    EXPECT_EQ(r.mesh.triangles.size(), static_cast<std::size_t>(n - 2));
    EXPECT_EQ(r.report.self_intersecting, 0u);
  }
}

TEST(Triangulate, RandomScribblesNeverThrowAndNeverLeaveNan) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> grid(0, 6), count(3, 14);
  for (int round = 0; round < 2000; ++round) {
    const auto ring = [&] {
      city::Ring out;
      for (int i = count(random); i > 0; --i)
        out.push_back({grid(random) * 0.1, grid(random) * 0.1, grid(random) * 0.001});
      return out;
    };
    const Result r = run({polygon(ring(), {ring()})});
    for (const glm::dvec3& p : r.mesh.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const MeshTriangle& t : r.mesh.triangles)
      for (const std::uint32_t v : t.vertex) ASSERT_LT(v, r.mesh.positions.size());
  }
}

TEST(Triangulate, SurfaceAndPolygonIndexComeAlong) {
  city::Polygon wall = polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}),
                roof = polygon(square(0, 0, 1, 1));
  wall.surface = city::SurfaceType::wall;
  roof.surface = city::SurfaceType::roof;
  const Result r = run({wall, roof});
  ASSERT_EQ(r.mesh.triangles.size(), 4u);
  EXPECT_EQ(r.mesh.triangles[0].surface, city::SurfaceType::wall);
  EXPECT_EQ(r.mesh.triangles[3].surface, city::SurfaceType::roof);
  EXPECT_EQ(r.mesh.triangles[3].polygon, 1u);
}

TEST(Classify, BlockGetsRoofWallsAndGround) {
  city::CityObject block;
  block.type = city::ObjectType::building;
  block.polygons = {polygon(reversed(square(0, 0, 5))), polygon(square(0, 0, 5, 8)),
                    polygon({{0, 0, 0}, {5, 0, 0}, {5, 0, 8}, {0, 0, 8}}),
                    polygon(square(0, 0, 5, 0))};
  block.polygons[3].surface = city::SurfaceType::closure;
  classify_unknown_surfaces(block);
  EXPECT_EQ(block.polygons[0].surface, city::SurfaceType::ground);
  EXPECT_EQ(block.polygons[1].surface, city::SurfaceType::roof);
  EXPECT_EQ(block.polygons[2].surface, city::SurfaceType::wall);
  EXPECT_EQ(block.polygons[3].surface, city::SurfaceType::closure);
}

// The area that a closed outline encloses an odd number of times, between the upright lines through
// all its corners and crossings: no triangulation.
double odd_area(const city::Ring& ring) {
  struct Edge {
    glm::dvec3 a, b;
    double height_at(double x) const { return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x); }
  };
  std::vector<Edge> edges;
  std::vector<double> lines;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec3 a = ring[i], b = ring[(i + 1) % ring.size()];
    lines.push_back(a.x);
    if (a.x != b.x) edges.push_back(a.x < b.x ? Edge{a, b} : Edge{b, a});
  }
  for (const Edge& e : edges)
    for (const Edge& f : edges) {
      const double slope = (e.b.y - e.a.y) / (e.b.x - e.a.x) - (f.b.y - f.a.y) / (f.b.x - f.a.x);
      if (std::abs(slope) > 1e-12) lines.push_back(e.a.x + (f.height_at(e.a.x) - e.a.y) / slope);
    }
  std::sort(lines.begin(), lines.end());
  double area = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double middle = (lines[i] + lines[i + 1]) / 2;
    std::vector<double> heights;
    for (const Edge& e : edges)
      if (e.a.x < middle && middle < e.b.x) heights.push_back(e.height_at(middle));
    std::sort(heights.begin(), heights.end());
    for (std::size_t k = 0; k + 1 < heights.size(); k += 2)
      area += (heights[k + 1] - heights[k]) * (lines[i + 1] - lines[i]);
  }
  return area;
}

TEST(Triangulate, ARingThatCrossesItselfManyTimes) {
  // Crossings rounded to doubles left CGAL's record of constraints incomplete here, and it read
  // invalid memory.
  const city::Ring ring{{1, 2, 0}, {4, 7, 0}, {4, 1, 0}, {1, 6, 0}, {4, 3, 0},
                        {6, 4, 0}, {3, 1, 0}, {2, 0, 0}, {6, 0, 0}, {2, 6, 0}};
  const Result r = run({polygon(ring)});
  EXPECT_EQ(r.report.self_intersecting, 1u);
  EXPECT_EQ(r.report.not_triangulated, 0u);
  EXPECT_NEAR(r.area, odd_area(ring), 1e-9);
}

TEST(Triangulate, RandomRingsCoverWhatTheyEncloseAnOddNumberOfTimes) {
  // A grid of few lines makes the worst of it: shared corners, edges on edges, three edges through
  // one point.
  std::mt19937 random(20);
  for (int n = 0; n < 3000; ++n) {
    city::Ring ring(5 + random() % 12);
    const unsigned size = 3 + random() % 8;
    for (glm::dvec3& p : ring) p = {random() % size, random() % size, 0};
    const Result r = run({polygon(ring)});
    ASSERT_EQ(r.report.not_triangulated, 0u) << n;
    // Dropped whole where the triangulation has no area at all.
    if (r.report.zero_area == 0) {
      ASSERT_NEAR(r.area, odd_area(ring), 1e-9) << n;
    }
  }
}

TEST(Triangulate, OutlinesThatCrossWithoutEndAreLeftOut) {
  // 1,000 needles, each across all others: half a million crossings.
  city::Ring ring;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 3.1 * i;
    ring.push_back({100 * std::cos(angle), 100 * std::sin(angle), 0});
  }
  const Result r = run({polygon(ring)});
  EXPECT_EQ(r.report.not_triangulated, 1u);
  EXPECT_EQ(r.mesh.triangles.size(), 0u);
  EXPECT_EQ(r.report.crossing_too_often, 1u);
}

TEST(Triangulate, TheLimitOfCrossingsCanBeLoweredAndRaised) {
  // A star of 41 points whose edges each cross 38 others.
  city::CityObject object;
  city::Ring ring;
  for (int i = 0; i < 41; ++i) {
    const double angle = 2 * std::numbers::pi * 20 * i / 41;
    ring.push_back({100 * std::cos(angle), 100 * std::sin(angle), 0});
  }
  object.polygons.push_back(polygon(ring));
  for (const int max_crossings : {1, 100}) {
    MeshReport report;
    EXPECT_EQ(triangulate(object, report, {.max_crossings = max_crossings}).triangles.empty(),
              max_crossings == 1);
    EXPECT_EQ(report.crossing_too_often, max_crossings == 1 ? 1u : 0u);
  }
}

TEST(Triangulate, TheLimitOfPointsCountsThoseOfHoles) {
  city::CityObject object;
  object.polygons.push_back(polygon({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}));
  object.polygons[0].interiors.push_back({{1, 1, 0}, {1, 2, 0}, {2, 1, 0}});
  for (const int max_points : {6, 7}) {
    MeshReport report;
    EXPECT_EQ(triangulate(object, report, {.max_points = max_points}).triangles.empty(),
              max_points == 6);
    EXPECT_EQ(report.too_many_points, max_points == 6 ? 1u : 0u);
    EXPECT_EQ(report.not_triangulated, report.too_many_points);
  }
}

}  // namespace
}  // namespace nightcity::mesh
