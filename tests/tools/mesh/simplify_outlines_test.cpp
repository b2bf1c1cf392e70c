#include "tools/mesh/simplify_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace nightcity::mesh {
namespace {

// A house whose outline in plan is given: floor, roof and a wall for each edge.
city::CityObject house(const std::vector<glm::dvec2>& plan, double height) {
  city::CityObject object;
  object.type = city::ObjectType::building;
  city::Polygon floor, roof;
  for (const glm::dvec2& p : plan) {
    roof.exterior.emplace_back(p, height);
    floor.exterior.insert(floor.exterior.begin(), glm::dvec3(p, 0));
  }
  object.polygons = {floor, roof};
  for (std::size_t n = 0; n < plan.size(); ++n) {
    const glm::dvec2 &a = plan[n], &b = plan[(n + 1) % plan.size()];
    city::Polygon wall;
    wall.exterior = {{a, 0}, {b, 0}, {b, height}, {a, height}};
    object.polygons.push_back(wall);
  }
  return object;
}

city::Polygon polygon_of(const city::Ring& ring) {
  city::Polygon result;
  result.exterior = ring;
  return result;
}

TEST(SimplifyOutlines, ABumpWithinTheToleranceGoesAndOneBeyondStays) {
  city::CityObject object;
  object.polygons = {
      polygon_of({{0, 0, 3}, {4, -0.1, 3}, {7, -0.3, 3}, {10, 0, 3}, {10, 8, 3}, {0, 8, 3}})};
  EXPECT_EQ(simplify_outlines(object, 0.2), 1u);
  EXPECT_EQ(object.polygons[0].exterior.size(), 5u);
  EXPECT_EQ(simplify_outlines(object, 0.5), 1u);
  EXPECT_EQ(object.polygons[0].exterior,
            (city::Ring{{0, 0, 3}, {10, 0, 3}, {10, 8, 3}, {0, 8, 3}}));
  EXPECT_EQ(simplify_outlines(object, 0.5), 0u);
}

// Walls end at each corner of the plan: a corner is passed by both of them along another edge, and
// stays, so that nothing comes apart.
TEST(SimplifyOutlines, ACornerWhereWallsMeetStays) {
  city::CityObject object = house({{0, 0}, {5, 0.05}, {10, 0}, {10, 8}, {0, 8}}, 6);
  EXPECT_EQ(simplify_outlines(object, 0.2), 0u);
  EXPECT_EQ(object.polygons[1].exterior.size(), 5u);
}

// A long wall and the roof over it both have vertices on their common edge, where nothing else
// ends.
TEST(SimplifyOutlines, SurfacesThatMetStillMeet) {
  city::CityObject object;
  const city::Ring edge{{2, 0, 6}, {4, 0.01, 6}, {7, 0, 6.02}};
  city::Ring wall{{0, 0, 0}, {10, 0, 0}, {10, 0, 6}}, roof{{0, 0, 6}};
  wall.insert(wall.end(), edge.rbegin(), edge.rend());
  wall.emplace_back(0, 0, 6);
  roof.insert(roof.end(), edge.begin(), edge.end());
  roof.insert(roof.end(), {{10, 0, 6}, {10, 8, 6}, {0, 8, 6}});
  object.polygons = {polygon_of(wall), polygon_of(roof)};
  EXPECT_EQ(simplify_outlines(object, 0.05), 3u);
  EXPECT_EQ(object.polygons[0].exterior.size(), 4u);
  EXPECT_EQ(object.polygons[1].exterior.size(), 4u);
}

TEST(SimplifyOutlines, NoVertexMovesFartherThanTheTolerance) {
  city::CityObject object;
  city::Ring circle;
  for (int n = 0; n < 360; ++n)
    circle.emplace_back(10 * std::cos(n * 0.0174533), 10 * std::sin(n * 0.0174533), 5);
  object.polygons = {polygon_of(circle)};
  EXPECT_GT(simplify_outlines(object, 0.1), 300u);
  const city::Ring& ring = object.polygons[0].exterior;
  ASSERT_GE(ring.size(), 16u);
  for (const glm::dvec3& p : circle) {
    double nearest = 1e9;
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const glm::dvec2 a(ring[n]), b(ring[(n + 1) % ring.size()]), edge = b - a;
      const double t =
          std::clamp(glm::dot(glm::dvec2(p) - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
      nearest = std::min(nearest, glm::distance(glm::dvec2(p), a + t * edge));
    }
    EXPECT_LE(nearest, 0.1 + 1e-9);
  }
}

TEST(SimplifyOutlines, RingsKeepThreeVertices) {
  city::CityObject object;
  object.polygons = {polygon_of({{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0, 0.5, 0}})};
  simplify_outlines(object, 10);
  EXPECT_EQ(object.polygons[0].exterior.size(), 4u);
  object.polygons = {polygon_of({}), polygon_of({{1, 1, 1}}), polygon_of({{1, 1, 1}, {2, 2, 2}})};
  EXPECT_EQ(simplify_outlines(object, 1), 0u);
  EXPECT_EQ(simplify_outlines(object, 0), 0u);
}

}  // namespace
}  // namespace nightcity::mesh
