#include "tools/bake/scene/drape.h"
#include "tools/bake/city/ready_object.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "support/temp_folder.h"

namespace nightcity::bake {
namespace {

city::CityObject road(double height) {
  city::CityObject object;
  object.type = city::ObjectType::road;
  object.polygons.push_back({"",
                             city::SurfaceType::traffic_area,
                             {{0, 0, height}, {9, 0, height}, {9, 9, height}},
                             {},
                             {}});
  return object;
}

TEST(Drape, OnlyWhatLiesAtZeroThroughoutLacksHeights) {
  EXPECT_TRUE(lacks_heights(road(0)));
  EXPECT_FALSE(lacks_heights(road(3)));
  city::CityObject partly = road(0);
  partly.polygons[0].exterior[1].z = 0.5;
  EXPECT_FALSE(lacks_heights(partly));
  city::CityObject house = road(0);
  house.type = city::ObjectType::building;
  EXPECT_FALSE(lacks_heights(house));
}

TEST(Drape, SubdividingKeepsTheAreaAndOpensNoCracks) {
  // Two triangles that share an edge; every inner edge must belong to exactly two pieces.
  const glm::dvec3 quads[2][3] = {{{0, 0, 0}, {97, 13, 0}, {80, 71, 0}},
                                  {{0, 0, 0}, {80, 71, 0}, {-20, 60, 0}}};
  const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  };
  using Point = std::tuple<double, double>;
  std::map<std::pair<Point, Point>, int> edges;
  double whole = 0, pieces = 0;
  for (const auto& corners : quads) {
    whole += area(corners[0], corners[1], corners[2]);
    subdivide(corners, 10, [&](const glm::dvec3(&t)[3]) {
      const double a = area(t[0], t[1], t[2]);
      EXPECT_GT(a, 0);
      pieces += a;
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &p = t[k], &q = t[(k + 1) % 3];
        EXPECT_LE(glm::distance(p, q), 10);
        edges[std::minmax(Point{p.x, p.y}, Point{q.x, q.y})] += 1;
      }
    });
  }
  EXPECT_NEAR(pieces, whole, 1e-9 * whole);
  double rim = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_LE(count, 2);
    if (count == 1)
      rim += std::hypot(std::get<0>(edge.first) - std::get<0>(edge.second),
                        std::get<1>(edge.first) - std::get<1>(edge.second));
  }
  const double perimeter =
      std::hypot(97, 13) + std::hypot(17, 58) + std::hypot(100, 11) + std::hypot(20, 60);
  EXPECT_NEAR(rim, perimeter, 1e-9 * perimeter)
      << "an edge cut on one side only would count as rim";
}

TEST(Drape, EveryVertexLiesJustAboveTheGroundAndKeepsItsColour) {
  const test::TempFolder folder;
  DrapeStore store(folder / "x");
  const MaterialCode red =
      to_code(BakeMaterial::road, glm::vec3(1, 0, 0));  // the model's own colour
  const TileStore::Triangle triangles[] = {
      {{{0, 0, 0}, {200, 0, 0}, {200, 8, 0}}, red, NodeKind::road},
      {{{0, 0, 0}, {200, 8, 0}, {0, 8, 0}}, red, NodeKind::road}};
  store.add(triangles, 5);
  TileStore tiles(folder / "x", 1000, 0);
  const auto ground = [](const glm::dvec2& p) { return std::optional(40 + 0.1 * p.x); };
  EXPECT_GT(store.drape(ground, tiles), 40u);
  const SceneMesh laid = tiles.mesh(tiles.tiles().at(0), glm::dmat4(1)).mesh;
  ASSERT_EQ(laid.primitives.size(), 1u);
  EXPECT_EQ(laid.primitives[0].material, red);
  for (const glm::vec3& p : laid.primitives[0].positions) {
    const double above = double{p.y} - (40 + 0.1 * double{p.x});
    EXPECT_GT(above, 0.02);
    EXPECT_LT(above, 0.2);
  }
  for (const std::uint32_t feature : laid.primitives[0].feature_ids) EXPECT_EQ(feature, 5u);
}

}  // namespace
}  // namespace nightcity::bake
