// A ground that reaches over a part of a city goes on around it.
#include "tools/terrain/made_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/plan_view.h"
#include "tools/terrain/outline.h"

namespace nightcity::terrain {
namespace {

double height_of_plane(double x, double y) {
  return 20 + 0.02 * x - 0.01 * y;
}

using Ring = std::vector<glm::dvec3>;

// A rectangle's ring on the plane, with a vertex every 10 m.
Ring make_ring(int west, int south, int east, int north) {
  Ring ring;
  for (int x = west; x < east; x += 10) ring.emplace_back(x, south, height_of_plane(x, south));
  for (int y = south; y < north; y += 10) ring.emplace_back(east, y, height_of_plane(east, y));
  for (int x = east; x > west; x -= 10) ring.emplace_back(x, north, height_of_plane(x, north));
  for (int y = north; y > south; y -= 10) ring.emplace_back(west, y, height_of_plane(west, y));
  return ring;
}

// Points of the plane all over a rectangle.
std::vector<glm::dvec3> spread_points(int west, int south, int east, int north) {
  std::vector<glm::dvec3> points;
  for (int x = west; x <= east; x += 15)
    for (int y = south; y <= north; y += 15) points.emplace_back(x, y, height_of_plane(x, y));
  return points;
}

bool covers(const mesh::TriangleMesh& mesh, double x, double y) {
  return !std::isnan(test::find_height(mesh, x, y));
}

TEST(SurfaceAround, MeetsTheGroundAtItsRingAndLeavesItFree) {
  const Ring ring = make_ring(0, 0, 100, 100);
  const auto around = make_surface_around({{ring}}, spread_points(0, 0, 300, 150), 50);
  // The rim reaches 50 m beyond the points and the ring.
  EXPECT_NEAR(test::find_plan_area(around.mesh), 400.0 * 250 - 100.0 * 100, 1e-6);
  EXPECT_FALSE(covers(around.mesh, 50.5, 40.25));
  EXPECT_TRUE(covers(around.mesh, 100.5, 40.25));
  // Seen from the other side the hole is the ring, to the vertex.
  Outline outline;
  outline.add(around.mesh);
  mesh::TriangleMesh ground;
  for (const glm::dvec3& p : ring) ground.positions.push_back(p);
  ground.positions.emplace_back(50, 50, height_of_plane(50, 50));
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i)
    ground.triangles.push_back({{i, (i + 1) % count, count}, city::SurfaceType::terrain, 0});
  outline.add(ground);
  const auto rings = outline.find_rings();
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_EQ(rings[0].size(), 32u) << "the rim's points alone";
}

TEST(SurfaceAround, PassesThroughThePointsOutside) {
  const auto points = spread_points(0, 0, 300, 150);
  const auto around = make_surface_around({{make_ring(0, 0, 100, 100)}}, points, 50);
  const auto outside = std::count_if(points.begin(), points.end(),
                                     [](const glm::dvec3& p) { return p.x > 100 || p.y > 100; });
  EXPECT_EQ(around.points, static_cast<std::size_t>(outside));
  for (const mesh::MeshTriangle& t : around.mesh.triangles)
    for (const std::uint32_t v : t.vertex) {
      const glm::dvec3& p = around.mesh.positions[v];
      const bool is_of_rim = p.x < 0 || p.y < 0 || p.x > 300 || p.y > 150;
      if (is_of_rim) continue;
      EXPECT_NEAR(p.z, height_of_plane(p.x, p.y), 1e-9);
    }
}

TEST(SurfaceAround, LiesBetweenTwoGroundsAndInNeither) {
  const auto around =
      make_surface_around({{make_ring(0, 0, 100, 100), make_ring(200, 0, 300, 100)}},
                          {{150, 50, height_of_plane(150, 50)}}, 50);
  EXPECT_EQ(around.points, 1u);
  EXPECT_NEAR(test::find_plan_area(around.mesh), 400.0 * 200 - 2 * 100.0 * 100, 1e-6);
  EXPECT_TRUE(covers(around.mesh, 150.5, 40.25));
  EXPECT_FALSE(covers(around.mesh, 250.5, 40.25));
}

// Tiles of two surveys overlap.
TEST(SurfaceAround, LeavesGroundsFreeThatCrossEachOther) {
  const auto around = make_surface_around(
      {{make_ring(0, 0, 100, 100), make_ring(50, 50, 150, 150)}}, {{200, 20, 30}}, 50);
  EXPECT_NEAR(test::find_plan_area(around.mesh), 300.0 * 250 - (2 * 100.0 * 100 - 50 * 50), 1e-6);
  for (const double p : {25.25, 75.25, 125.25}) EXPECT_FALSE(covers(around.mesh, p, p + 0.5));
}

TEST(SurfaceAround, IsAllOfItsRectangleWithoutAGround) {
  const auto around = make_surface_around({}, {{0, 0, 5}, {100, 50, 7}}, 50);
  EXPECT_EQ(around.points, 2u);
  EXPECT_NEAR(test::find_plan_area(around.mesh), 200.0 * 150, 1e-6);
}

}  // namespace
}  // namespace nightcity::terrain
