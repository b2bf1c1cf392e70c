#include "tools/terrain/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nightcity::terrain {
namespace {

// A grid of squares of 10 m, without those that `left_out` names; clockwise where `flipped`.
template <class LeftOut>
mesh::TriangleMesh make_grid(int west, int east, const LeftOut& left_out, bool flipped = false) {
  mesh::TriangleMesh mesh;
  for (int i = west; i < east; ++i)
    for (int j = 0; j < 4; ++j) {
      if (left_out(i, j)) continue;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& [x, y] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
        mesh.positions.emplace_back(10 * x, 10 * y, x + y);
      mesh.triangles.push_back({{first, first + 1, first + 2}, city::SurfaceType::terrain, 0});
      mesh.triangles.push_back({{first, first + 2, first + 3}, city::SurfaceType::terrain, 0});
      if (flipped)
        for (std::size_t k = mesh.triangles.size() - 2; k < mesh.triangles.size(); ++k)
          std::swap(mesh.triangles[k].vertex[0], mesh.triangles[k].vertex[1]);
    }
  return mesh;
}

constexpr auto nothing = [](int, int) { return false; };

double area_of(const std::vector<glm::dvec3>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

TEST(Outline, IsOneRingOfTheGroundsOwnVertices) {
  Outline outline;
  outline.add(make_grid(0, 5, nothing));
  const auto rings = outline.find_rings();
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_EQ(rings[0].size(), 18u);
  EXPECT_DOUBLE_EQ(area_of(rings[0]), 50 * 40);
  for (const glm::dvec3& p : rings[0]) EXPECT_EQ(p.z, (p.x + p.y) / 10);
}

TEST(Outline, IsTheSameInWhicheverPiecesOrderAndWindingTheGroundComes) {
  Outline whole, pieces, east;
  whole.add(make_grid(0, 6, nothing));
  east.add(make_grid(3, 6, nothing, true));
  pieces.add(east);
  pieces.add(make_grid(0, 3, nothing));
  EXPECT_EQ(whole.find_rings(), pieces.find_rings());
}

TEST(Outline, LeavesOutHolesAndFindsEveryPart) {
  Outline outline;
  outline.add(make_grid(0, 4, [](int i, int j) { return i == 1 && j == 1; }));
  outline.add(make_grid(7, 9, nothing));
  const auto rings = outline.find_rings();
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_DOUBLE_EQ(area_of(rings[0]) + area_of(rings[1]), 40 * 40 + 20 * 40);
}

TEST(Outline, PartsThatMeetInACornerAreRingsOfTheirOwn) {
  Outline outline;
  outline.add(make_grid(0, 2, [](int i, int j) { return (i + j) % 2 != 0 || j > 1; }));
  const auto rings = outline.find_rings();
  ASSERT_EQ(rings.size(), 2u);
  for (const auto& ring : rings) EXPECT_DOUBLE_EQ(area_of(ring), 100);
}

TEST(Outline, AVertexThatOneSideLacksMakesNoHole) {
  Outline outline;
  outline.add(make_grid(0, 2, nothing));
  // One large square beside four small ones.
  mesh::TriangleMesh large;
  large.positions = {{20, 0, 2}, {60, 0, 2}, {60, 40, 2}, {20, 40, 2}};
  large.triangles = {{{0, 1, 2}, city::SurfaceType::terrain, 0},
                     {{0, 2, 3}, city::SurfaceType::terrain, 0}};
  outline.add(large);
  double area = 0;
  for (const auto& ring : outline.find_rings()) area += area_of(ring);
  EXPECT_DOUBLE_EQ(area, 60 * 40);
}

TEST(Outline, OfNothingButUprightAndBadTrianglesIsEmpty) {
  mesh::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, std::nan(""), 0}, {1e300, 0, 0}};
  for (const std::uint32_t third : {2u, 3u, 4u})
    mesh.triangles.push_back({{0, 1, third}, city::SurfaceType::terrain, 0});
  Outline outline;
  outline.add(mesh);
  EXPECT_TRUE(outline.find_rings().empty());
}

}  // namespace
}  // namespace nightcity::terrain
