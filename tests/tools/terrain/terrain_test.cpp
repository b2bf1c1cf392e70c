// Surfaces whose height is known in closed form, at coordinates as large as a national grid's.
#include "tools/terrain/terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "tools/terrain/made_surface.h"

namespace nightcity::terrain {
namespace {

constexpr double east = 412345.678, north = 5762345.678;

/// Two triangles over a rectangle, heights from a function of local coordinates.
template <class Height>
void add_rectangle(mesh::TriangleMesh& mesh, double x0, double y0, double x1, double y1,
                   Height height) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}})
    mesh.positions.emplace_back(east + x, north + y, height(x, y));
  mesh.triangles.push_back({{base, base + 1, base + 2}, city::SurfaceType::unknown, 0});
  mesh.triangles.push_back({{base, base + 2, base + 3}, city::SurfaceType::unknown, 0});
}

template <class Height>
mesh::TriangleMesh rectangle(double x0, double y0, double x1, double y1, Height height) {
  mesh::TriangleMesh mesh;
  add_rectangle(mesh, x0, y0, x1, y1, height);
  return mesh;
}

mesh::TriangleMesh flat(double x0, double y0, double x1, double y1, double z) {
  return rectangle(x0, y0, x1, y1, [z](double, double) { return z; });
}

TEST(Terrain, InclinedPlaneIsReproducedToMicrometresOnEdgesAndCornersToo) {
  const auto plane = [](double x, double y) { return 50 + 0.1 * x - 0.05 * y; };
  mesh::TriangleMesh mesh;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      add_rectangle(mesh, i * 10, j * 10, i * 10 + 10, j * 10 + 10, plane);
  Terrain terrain;
  terrain.add(mesh, SurfaceClass::terrain);
  terrain.build(100);
  EXPECT_TRUE(terrain.made_surface().triangles.empty());
  for (double x = 0; x <= 100; x += 2.5)
    for (double y = 0; y <= 100; y += 2.5) {
      const auto hit = terrain.height_at({east + x, north + y});
      ASSERT_TRUE(hit) << x << " " << y;
      EXPECT_EQ(hit->surface, SurfaceClass::terrain);
      EXPECT_NEAR(hit->height_m, plane(x, y), 1e-6);
    }
}

TEST(Terrain, OutsideAndInHolesThereIsNothing) {
  mesh::TriangleMesh frame;  // a square ring around a hole from (10, 10) to (20, 20)
  const auto zero = [](double, double) { return 0.0; };
  add_rectangle(frame, 0, 0, 30, 10, zero);
  add_rectangle(frame, 0, 20, 30, 30, zero);
  add_rectangle(frame, 0, 10, 10, 20, zero);
  add_rectangle(frame, 20, 10, 30, 20, zero);
  Terrain terrain;
  terrain.add(frame, SurfaceClass::terrain);
  terrain.build(100);
  EXPECT_TRUE(terrain.height_at({east + 5, north + 15}));
  EXPECT_FALSE(terrain.height_at({east + 15, north + 15}));
  EXPECT_FALSE(terrain.height_at({east - 0.01, north + 5}));
  EXPECT_FALSE(terrain.height_at({east + 1000, north}));
  EXPECT_FALSE(terrain.height_at({std::nan(""), north}));
}

TEST(Terrain, OnAStepTheGreaterHeightOfOneClassWins) {
  mesh::TriangleMesh step;
  add_rectangle(step, 0, 0, 10, 10, [](double, double) { return 1.0; });
  add_rectangle(step, 10, 0, 20, 10, [](double, double) { return 4.0; });
  Terrain terrain;
  terrain.add(step, SurfaceClass::terrain);
  terrain.build(0);
  EXPECT_NEAR(terrain.height_at({east + 9.999, north + 5})->height_m, 1, 1e-9);
  EXPECT_NEAR(terrain.height_at({east + 10.001, north + 5})->height_m, 4, 1e-9);
  EXPECT_NEAR(terrain.height_at({east + 10, north + 5})->height_m, 4, 1e-9);
}

TEST(Terrain, TerrainWinsOverRoadOverGroundOverRoofWhateverTheHeights) {
  const auto hit = [](std::initializer_list<std::pair<SurfaceClass, double>> layers) {
    Terrain terrain;
    for (const auto& [surface, z] : layers) terrain.add(flat(0, 0, 10, 10, z), surface);
    // A piece of terrain far away, so that no surface is made.
    terrain.add(flat(100, 100, 110, 110, 0), SurfaceClass::terrain);
    terrain.build(0);
    return terrain.height_at({east + 3, north + 4});
  };
  EXPECT_EQ(hit({{SurfaceClass::roof, 30},
                 {SurfaceClass::ground_surface, 5},
                 {SurfaceClass::road, 6},
                 {SurfaceClass::terrain, 4}})
                ->height_m,
            4);
  EXPECT_EQ(
      hit({{SurfaceClass::roof, 30}, {SurfaceClass::ground_surface, 5}, {SurfaceClass::road, 6}})
          ->height_m,
      6);
  EXPECT_EQ(hit({{SurfaceClass::roof, 30}, {SurfaceClass::ground_surface, 5}})->height_m, 5);
  EXPECT_EQ(hit({{SurfaceClass::roof, 30}})->surface, SurfaceClass::roof);
  EXPECT_FALSE(hit({}));
}

TEST(Terrain, MadeSurfacePassesThroughGroundSurfacesAndReachesItsMargin) {
  const auto plane = [](double x, double y) { return 20 + 0.02 * x + 0.01 * y; };
  Terrain terrain;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      terrain.add(rectangle(i * 30, j * 30, i * 30 + 10, j * 30 + 10, plane),
                  SurfaceClass::ground_surface);
  terrain.add(flat(0, 0, 10, 10, 40), SurfaceClass::roof);
  terrain.build(200);
  EXPECT_FALSE(terrain.made_surface().triangles.empty());
  for (const glm::dvec2 p : {glm::dvec2(5, 5), {15, 15}, {20, 65}, {129, 129}, {77, 31}}) {
    const auto hit = terrain.height_at({east + p.x, north + p.y});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->surface, SurfaceClass::terrain);
    EXPECT_NEAR(hit->height_m, plane(p.x, p.y), 1e-6);
  }
  EXPECT_TRUE(terrain.height_at({east - 199, north - 199}));
  EXPECT_TRUE(terrain.height_at({east + 329, north + 329}));
  EXPECT_FALSE(terrain.height_at({east - 201, north}));
  // Between the outermost houses and the rim heights stay within those of the houses.
  for (const auto& p : terrain.made_surface().positions) {
    EXPECT_GE(p.z, plane(0, 0) - 1e-9);
    EXPECT_LE(p.z, plane(130, 130) + 1e-9);
  }
}

TEST(Terrain, NoTriangleReachesAcrossABreakLine) {
  // A dyke's crest between meadows: the points beside it are nearer to each other than the crest's
  // ends.
  Terrain terrain;
  std::vector<glm::dvec3> meadow;
  for (int x = 0; x <= 100; x += 10)
    for (const int y : {-2, 2}) meadow.push_back({east + x, north + y, 1});
  terrain.add_points(meadow);
  EXPECT_TRUE(terrain.add_break_line({{east + 1, north, 6}, {east + 99, north, 8}}));
  terrain.build(5);
  for (double x = 1; x <= 99; x += 0.7)
    EXPECT_NEAR(terrain.height_at({east + x, north})->height_m, 6 + 2 * (x - 1) / 98, 1e-6) << x;
  EXPECT_NEAR(terrain.height_at({east + 50, north + 2})->height_m, 1, 1e-6);
  EXPECT_EQ(terrain.break_edges().used, 1u);
  EXPECT_EQ(terrain.break_edges().unused, 0u);
}

TEST(Terrain, BreakLinesThatCrossMeetInAVertex) {
  const BreakSurface surface = make_surface(
      {}, std::vector<std::vector<glm::dvec3>>{{{0, 0, 4}, {10, 10, 4}}, {{0, 10, 4}, {10, 0, 4}}},
      5);
  EXPECT_EQ(surface.edges, 2u);
  double area = 0;
  bool met = false;
  for (const mesh::MeshTriangle& t : surface.mesh.triangles) {
    const auto p = [&](int k) { return glm::dvec2(surface.mesh.positions.at(t.vertex[k])); };
    const glm::dvec2 u = p(1) - p(0), v = p(2) - p(0);
    EXPECT_GT(u.x * v.y - u.y * v.x, 0);
    area += (u.x * v.y - u.y * v.x) / 2;
    for (int k = 0; k < 3; ++k) met |= glm::distance(p(k), glm::dvec2(5, 5)) < 1e-9;
  }
  EXPECT_NEAR(area, 400, 1e-9);
  EXPECT_TRUE(met);
}

// Places of a small grid, so that lines run through vertices, lie on each other and go back on
// themselves.
TEST(Terrain, WhateverTheBreakLinesTheSurfaceCoversItsRectangleOnce) {
  unsigned state = 1;
  const auto random = [&state](unsigned below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>((state >> 16) % below);
  };
  for (int round = 0; round < 200; ++round) {
    std::vector<std::vector<glm::dvec3>> lines(1 + static_cast<std::size_t>(random(12)));
    for (auto& line : lines)
      for (int n = 0; n < 6; ++n)
        line.emplace_back(east + random(7), north + random(7), random(20));
    const BreakSurface surface = make_surface({{east + 3, north + 3, 1}}, lines, 4);
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::dvec3& p : surface.mesh.positions) {
      EXPECT_TRUE(std::isfinite(p.z) && p.z >= 0 && p.z <= 20);
      low = glm::min(low, glm::dvec2(p));
      high = glm::max(high, glm::dvec2(p));
    }
    double area = 0;
    for (const mesh::MeshTriangle& t : surface.mesh.triangles) {
      const auto p = [&](int k) { return glm::dvec2(surface.mesh.positions.at(t.vertex[k])); };
      const glm::dvec2 u = p(1) - p(0), v = p(2) - p(0);
      EXPECT_GE(u.x * v.y - u.y * v.x, -1e-6);
      area += (u.x * v.y - u.y * v.x) / 2;
    }
    EXPECT_NEAR(area, (high.x - low.x) * (high.y - low.y), 1e-4);
  }
}

TEST(Terrain, LinesThatCrossBeyondReasonAreCountedNotFollowed) {
  std::vector<std::vector<glm::dvec3>> lines;
  for (int n = 0; n < 100; ++n) {
    lines.push_back({{-1, n, 0}, {100, n + 0.5, 0}});
    lines.push_back({{n, -1, 0}, {n + 0.5, 100, 0}});
  }
  lines.push_back({{NAN, 0, 0}, {1, 1, 1}, {1, 1, 1}});
  const BreakSurface surface = make_surface({}, lines, 5);
  EXPECT_GT(surface.unused_edges, 0u);
  EXPECT_EQ(surface.edges + surface.unused_edges, 200u);
  EXPECT_LT(surface.mesh.positions.size(), 5000u);
}

TEST(Terrain, MadeSurfaceLooksUpAndTakesTheLowestOfCoincidentPoints) {
  const mesh::TriangleMesh mesh =
      make_surface({{0, 0, 5}, {0, 0, 2}, {10, 0, 2}, {0, 10, 2}, {10, 10, 2}, {4, 4, NAN}}, 5);
  ASSERT_FALSE(mesh.triangles.empty());
  double area = 0;
  for (const mesh::MeshTriangle& t : mesh.triangles) {
    const auto &a = mesh.positions[t.vertex[0]], &b = mesh.positions[t.vertex[1]],
               &c = mesh.positions[t.vertex[2]];
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 20 * 20, 1e-9);
  for (const auto& p : mesh.positions) EXPECT_EQ(p.z, 2);
  EXPECT_TRUE(make_surface({}, 10).triangles.empty());
  EXPECT_FALSE(make_surface({{1, 2, 3}}, 0).triangles.empty());
}

TEST(Terrain, MassPointsOfTheModelAreItsGroundBeforeTheBuildings) {
  Terrain terrain;
  const auto plane = [](double x, double y) { return 3 + 0.1 * x + 0.2 * y; };
  std::vector<glm::dvec3> points;
  for (int x = 0; x <= 100; x += 20)
    for (int y = 0; y <= 100; y += 20) points.emplace_back(east + x, north + y, plane(x, y));
  terrain.add_points(points);
  terrain.add(flat(40, 40, 50, 50, 77), SurfaceClass::ground_surface);
  EXPECT_TRUE(terrain.has_relief());
  terrain.build(10);
  EXPECT_NEAR(terrain.height_at({east + 33, north + 71})->height_m, plane(33, 71), 1e-6);
  EXPECT_EQ(terrain.height_at({east + 45, north + 45})->surface, SurfaceClass::terrain);
}

TEST(Terrain, RoadsCarryTheSurfaceWhereThereIsNoGround) {
  Terrain terrain;
  terrain.add(flat(0, 0, 10, 10, 7), SurfaceClass::road);
  terrain.build(50);
  EXPECT_NEAR(terrain.height_at({east + 40, north + 40})->height_m, 7, 1e-9);
}

TEST(Terrain, KnowsWhatIsBuiltOver) {
  Terrain terrain;
  terrain.add(flat(-50, -50, 50, 50, 0), SurfaceClass::terrain);
  terrain.add(flat(0, 0, 10, 10, 12), SurfaceClass::roof);
  terrain.build(0);
  EXPECT_TRUE(terrain.inside_building({east + 5, north + 5}));
  EXPECT_FALSE(terrain.inside_building({east + 15, north + 5}));
}

TEST(Terrain, WallsSliversAndBrokenVerticesCarryNobody) {
  mesh::TriangleMesh mesh = flat(0, 0, 10, 10, std::numeric_limits<double>::quiet_NaN());
  add_rectangle(mesh, 0, 5, 10, 5, [](double x, double) { return x; });
  Terrain terrain;
  terrain.add(mesh, SurfaceClass::terrain);
  terrain.build(10);
  EXPECT_FALSE(terrain.height_at({east + 5, north + 5}));
  Terrain empty;
  empty.build(10);
  EXPECT_FALSE(empty.height_at({0, 0}));
  EXPECT_FALSE(empty.inside_building({0, 0}));
}

}  // namespace
}  // namespace nightcity::terrain
