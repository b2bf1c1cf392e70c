#include "tools/terrain/thin_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "support/plan_view.h"

namespace nightcity::terrain {
namespace {

using test::find_height;
using test::find_plan_area;

using Height = std::function<double(double x, double y)>;

// A grid of n by n squares of a metre, as the ground of an elevation model is made.
mesh::TriangleMesh grid(std::uint32_t n, const Height& height) {
  mesh::TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(x, y, height(x, y));
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = c - 1;
      mesh.triangles.push_back({{a, b, c}, city::SurfaceType::terrain, 0});
      mesh.triangles.push_back({{a, c, d}, city::SurfaceType::terrain, 0});
    }
  return mesh;
}

// All vertices of the sides but the corners.
std::vector<bool> sides_of(std::uint32_t n) {
  std::vector<bool> loose((n + 1) * (n + 1));
  for (std::uint32_t k = 1; k < n; ++k)
    loose[k] = loose[n * (n + 1) + k] = loose[k * (n + 1)] = loose[k * (n + 1) + n] = true;
  return loose;
}

double worst_error(const mesh::TriangleMesh& whole, const mesh::TriangleMesh& thin) {
  double worst = 0;
  for (const glm::dvec3& p : whole.positions)
    worst = std::max(worst, std::abs(find_height(thin, p.x, p.y) - p.z));
  return worst;
}

TEST(ThinSurface, APlaneBecomesTwoTriangles) {
  const auto plane = [](double x, double y) { return 30 + 0.25 * x - 0.125 * y; };
  const mesh::TriangleMesh thin = thin_surface(grid(32, plane), 0.01, sides_of(32));
  EXPECT_EQ(thin.triangles.size(), 2u);
  EXPECT_EQ(thin.positions.size(), 4u);
  EXPECT_EQ(find_plan_area(thin), 32 * 32);
}

TEST(ThinSurface, EveryVertexThatIsLeftOutLiesWithinTheError) {
  const auto hills = [](double x, double y) { return 3 * std::sin(x / 5) + 2 * std::cos(y / 7); };
  const mesh::TriangleMesh whole = grid(40, hills);
  std::size_t fewer = whole.triangles.size() + 1;
  for (const double error : {0.001, 0.03, 0.1, 0.3, 1.0}) {
    const mesh::TriangleMesh thin = thin_surface(whole, error);
    EXPECT_LE(worst_error(whole, thin), error + 1e-9) << error;
    EXPECT_NEAR(find_plan_area(thin), 1600, 1e-6);
    EXPECT_LE(thin.triangles.size(), fewer) << error;
    fewer = thin.triangles.size();
  }
  EXPECT_LT(fewer, whole.triangles.size() / 5);
}

TEST(ThinSurface, APeakStays) {
  const auto peak = [](double x, double y) { return x == 9 && y == 5 ? 2.0 : 0.0; };
  const mesh::TriangleMesh thin = thin_surface(grid(16, peak), 0.5, sides_of(16));
  EXPECT_EQ(find_height(thin, 9, 5), 2);
  EXPECT_LT(thin.triangles.size(), 60u);
}

// An outline that goes round a hole and a corner, each place once and each triangle with vertices
// of its own, as an object's are.
TEST(ThinSurface, TheOutlineStaysWithItsHoles) {
  mesh::TriangleMesh whole = grid(12, [](double, double) { return 4.0; }), loose;
  std::erase_if(whole.triangles, [&](const mesh::MeshTriangle& t) {
    const glm::dvec3& p = whole.positions[t.vertex[0]];
    return (p.x >= 4 && p.x < 7 && p.y >= 5 && p.y < 8) || (p.x >= 9 && p.y >= 9);
  });
  for (const mesh::MeshTriangle& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t v : t.vertex) loose.positions.push_back(whole.positions[v]);
    loose.triangles.push_back({{first, first + 1, first + 2}, t.surface, 0});
  }
  const mesh::TriangleMesh thin = thin_surface(loose, 0.1);
  EXPECT_NEAR(find_plan_area(thin), 144 - 9 - 9, 1e-9);
  EXPECT_LT(thin.triangles.size(), loose.triangles.size() / 2);
  // Each vertex of the outline is still there: 48 around, 12 of the hole.
  EXPECT_EQ(thin.positions.size(), 60u);
}

TEST(ThinSurface, WhatIsNoHeightFieldStaysAsItIs) {
  const auto flat = [](double, double) { return 0.0; };
  mesh::TriangleMesh down = grid(4, flat);
  std::swap(down.triangles[3].vertex[0], down.triangles[3].vertex[1]);
  EXPECT_EQ(thin_surface(down, 1).triangles.size(), down.triangles.size());
  mesh::TriangleMesh upright = grid(4, flat);
  upright.positions[6] = {0, 0, 5};  // above another vertex
  EXPECT_EQ(thin_surface(upright, 1).triangles.size(), upright.triangles.size());
  mesh::TriangleMesh twice = grid(4, flat);
  twice.triangles.push_back(twice.triangles.front());
  EXPECT_EQ(thin_surface(twice, 1).triangles.size(), twice.triangles.size());
  mesh::TriangleMesh overlapping = grid(4, flat);
  const auto first = static_cast<std::uint32_t>(overlapping.positions.size());
  for (const glm::dvec3& p :
       {glm::dvec3(0.5, 0.25, 0), glm::dvec3(3.5, 0.25, 0), glm::dvec3(2, 3.25, 0)})
    overlapping.positions.push_back(p);
  overlapping.triangles.push_back({{first, first + 1, first + 2}, city::SurfaceType::terrain, 0});
  EXPECT_EQ(thin_surface(overlapping, 1).triangles.size(), overlapping.triangles.size());
  mesh::TriangleMesh not_finite = grid(4, flat);
  not_finite.positions[7].z = std::nan("");
  EXPECT_EQ(thin_surface(not_finite, 1).triangles.size(), not_finite.triangles.size());
  EXPECT_TRUE(thin_surface({}, 1).triangles.empty());
}

TEST(ThinSurface, ALineNeedsItsEndsAndWhatLiesOffIt) {
  using Needed = std::vector<bool>;
  EXPECT_EQ(find_needed(std::vector<double>{0, 1, 2, 3}, 0.01), (Needed{true, false, false, true}));
  EXPECT_EQ(find_needed(std::vector<double>{0, 0, 5, 0, 0}, 0.1),
            (Needed{true, true, true, true, true}));
  EXPECT_EQ(find_needed(std::vector<double>{0, 2, 4, 2, 0}, 0.1),
            (Needed{true, false, true, false, true}));
  EXPECT_EQ(find_needed(std::vector<double>{7}, 0.1), Needed{true});
  EXPECT_TRUE(find_needed({}, 0.1).empty());
}

}  // namespace
}  // namespace nightcity::terrain
