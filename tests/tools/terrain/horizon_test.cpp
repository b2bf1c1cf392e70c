#include "tools/terrain/horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>

namespace nightcity::terrain {
namespace {

using std::numbers::pi;
using Ring = std::vector<glm::dvec3>;

// An L of three squares of 400 m, at heights that rise to the east.
Ring make_l() {
  Ring ring;
  for (const auto& [x, y] :
       {std::pair{0, 0}, {800, 0}, {800, 400}, {400, 400}, {400, 800}, {0, 800}})
    ring.emplace_back(x, y, 30 + x * 0.01);
  return ring;
}

double plan_area(const mesh::TriangleMesh& mesh, const mesh::MeshTriangle& t) {
  const glm::dvec3 u = mesh.positions[t.vertex[1]] - mesh.positions[t.vertex[0]],
                   v = mesh.positions[t.vertex[2]] - mesh.positions[t.vertex[0]];
  return (u.x * v.y - u.y * v.x) / 2;
}

// The area within the horizon of a rectangle: its arcs are those of a polygon of 32 corners.
double find_area(double width, double depth) {
  return width * depth + 2 * horizon_m * (width + depth) +
         16 * horizon_m * horizon_m * std::sin(2 * pi / 32);
}

TEST(Horizon, CoversThePlaneAroundTheGroundOnceAndNothingOfIt) {
  const mesh::TriangleMesh mesh = make_horizon(std::vector<Ring>{make_l()});
  double area = 0;
  for (const mesh::MeshTriangle& t : mesh.triangles) {
    EXPECT_GT(plan_area(mesh, t), 0) << "it faces upwards";
    area += plan_area(mesh, t);
    const glm::dvec3 middle =
        (mesh.positions[t.vertex[0]] + mesh.positions[t.vertex[1]] + mesh.positions[t.vertex[2]]) /
        3.0;
    EXPECT_FALSE(middle.x > 0 && middle.y > 0 && std::max(middle.x, middle.y) < 800 &&
                 std::min(middle.x, middle.y) < 400);
  }
  EXPECT_NEAR(area / (find_area(800, 800) - 3 * 400.0 * 400), 1, 1e-9);
  EXPECT_LT(mesh.triangles.size(), 2000u);
}

TEST(Horizon, BeginsAtTheEdgeAndFallsAsTheEarthDoes) {
  const mesh::TriangleMesh mesh = make_horizon(std::vector<Ring>{make_l()});
  const double mean = 30 + (0 + 8 + 8 + 4 + 4 + 0) / 6.0;
  std::size_t on_edge = 0;
  for (const glm::dvec3& p : mesh.positions) {
    double distance = 1e300;
    for (const glm::dvec3& q : make_l())
      distance = std::min(distance, glm::distance(glm::dvec2(p), glm::dvec2(q)));
    if (distance == 0) {
      ++on_edge;
      EXPECT_EQ(p.z, 30 + p.x * 0.01);
    } else if (distance > 1000) {
      EXPECT_NEAR(p.z, mean - distance * distance / (2 * earth_radius_m), 1e-6);
    } else {
      EXPECT_NEAR(p.z, mean, 5);
    }
  }
  EXPECT_EQ(on_edge, 6u);
}

// Each edge within belongs to two triangles: there is no crack through which the void shows.
TEST(Horizon, IsWithoutCracks) {
  const mesh::TriangleMesh mesh = make_horizon(std::vector<Ring>{make_l()});
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const mesh::MeshTriangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t.vertex[k], b = t.vertex[(k + 1) % 3];
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  double open_m = 0;
  for (const auto& [edge, surplus] : edges)
    if (surplus != 0)
      open_m += glm::distance(glm::dvec2(mesh.positions[edge.first]),
                              glm::dvec2(mesh.positions[edge.second]));
  const double rim_m = 4 * 800 + 32 * 2 * horizon_m * std::sin(pi / 32);
  EXPECT_NEAR(open_m, 8 * 400 + rim_m, 1e-3);
}

TEST(Horizon, GoesRoundSeveralPartsAndPassesOverRingsWithinOthers) {
  Ring other = make_l(), within;
  for (glm::dvec3& p : other) p.x += 2000;
  for (const auto& [x, y] : {std::pair{100, 100}, {200, 100}, {200, 200}, {100, 200}})
    within.emplace_back(x, y, 0);
  const mesh::TriangleMesh mesh = make_horizon(std::vector<Ring>{within, make_l(), other});
  double area = 0;
  for (const mesh::MeshTriangle& t : mesh.triangles) area += plan_area(mesh, t);
  EXPECT_NEAR(area, find_area(2800, 800) - 6 * 400.0 * 400, 1);
  for (const glm::dvec3& p : mesh.positions) EXPECT_NE(p.z, 0) << "a vertex of the ring within";
}

TEST(Horizon, OfNoGroundIsNothing) {
  EXPECT_TRUE(make_horizon({}).triangles.empty());
}

}  // namespace
}  // namespace nightcity::terrain
