#include "tools/bake/scene/ground_facets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::bake {
namespace {

using Stored = TileStore::StoredTriangle;

// A grid of squares of 10 m, two triangles each, with a height for each place.
template <class Height>
std::vector<Stored> make_grid(int side, const Height& height) {
  std::vector<Stored> triangles;
  const auto at = [&](int i, int j) {
    return glm::vec3(10 * i, height(10.0 * i, 10.0 * j), -10 * j);
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const glm::vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      triangles.push_back({{a, b, c}, to_code(BakeMaterial::terrain), no_id, 0});
      triangles.push_back({{a, c, d}, to_code(BakeMaterial::terrain), no_id, 0});
    }
  return triangles;
}

double area_of(const mesh::PlaneArea& area) {
  double sum = 0;
  for (const auto& ring : area.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      sum += (a.x * b.y - a.y * b.x) / 2;
    }
  return sum;
}

TEST(GroundFacets, APlaneIsOneFacetWithAllCornersOfItsRim) {
  const auto facets = find_facets(make_grid(5, [](double x, double y) { return x / 10 + y / 20; }));
  ASSERT_EQ(facets.size(), 1u);
  ASSERT_EQ(facets[0].rings.size(), 1u);
  EXPECT_EQ(facets[0].rings[0].size(), 20u);
  EXPECT_NEAR(area_of(facets[0]), 2500, 1e-9);
}

TEST(GroundFacets, FacetsPartTheGroundOfARoof) {
  const auto facets =
      find_facets(make_grid(4, [](double x, double) { return std::abs(x - 20) / 5; }));
  ASSERT_EQ(facets.size(), 2u);
  EXPECT_NEAR(area_of(facets[0]), 800, 1e-9);
  EXPECT_NEAR(area_of(facets[1]), 800, 1e-9);
}

TEST(GroundFacets, AHoleIsARingOfItsOwn) {
  // A peak in the middle of a plane: its six triangles are facets of their own.
  const auto facets =
      find_facets(make_grid(6, [](double x, double y) { return x == 30 && y == 30 ? 2.0 : 0.0; }));
  double whole = 0;
  bool has_hole = false;
  for (const auto& facet : facets) {
    whole += area_of(facet);
    has_hole |= facet.rings.size() == 2;
  }
  EXPECT_TRUE(has_hole);
  EXPECT_NEAR(whole, 3600, 1e-9);
}

TEST(GroundFacets, OtherFeaturesAndOverlapsStayApart) {
  std::vector<Stored> triangles = make_grid(1, [](double, double) { return 0.0; });
  triangles[1].feature = 7;
  EXPECT_EQ(find_facets(triangles).size(), 2u);
  const Stored twice[] = {triangles[0], triangles[0]};
  triangles.insert(triangles.end(), twice, twice + 2);
  double whole = 0;
  for (const auto& facet : find_facets(triangles)) whole += area_of(facet);
  EXPECT_NEAR(whole, 200, 1e-9);
  EXPECT_TRUE(find_facets({}).empty());
}

}  // namespace
}  // namespace nightcity::bake
