#include "tools/bake/scene/cover_ground.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "tools/roads/road_class.h"

namespace nightcity::bake {
namespace {

using ground_cover::Cover;
using ground_cover::CoverArea;
using ground_cover::GroundKind;
using Stored = TileStore::StoredTriangle;

constexpr std::uint32_t relief_feature = 5;

// A slope of 100 m by 100 m that rises by `slope` a metre to the east, from two triangles.
std::vector<Stored> make_slope(float slope) {
  const glm::vec3 a(0, 0, 0), b(100, 100 * slope, 0), c(100, 100 * slope, -100), d(0, 0, -100);
  const MaterialCode terrain = to_code(BakeMaterial::terrain);
  return {{{a, b, c}, terrain, relief_feature, 0}, {{a, c, d}, terrain, relief_feature, 0}};
}

CoverArea band(int rank, double south, double north, ground_cover::Surface surface) {
  return {rank, surface, {{{-10, south}, {110, south}, {110, north}, {-10, north}}}};
}

double plan_area(const Stored& t) {
  const glm::vec3 normal = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
  return normal.y / 2.0;
}

double& at(CoverCounts& counts, GroundKind kind) {
  return counts.area_m2[static_cast<std::size_t>(kind)];
}

TEST(CoverGround, CutsTheGroundIntoPartsThatAddUp) {
  Cover cover;
  cover.add(band(2, 40, 46, {GroundKind::asphalt, true, true}));
  cover.add(band(1, 30, 50, {GroundKind::paving_stones, false, false}));
  cover.finish();
  std::vector<Stored> triangles = make_slope(0.1f);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  EXPECT_NEAR(at(counts, GroundKind::asphalt), 600, 1e-2);
  EXPECT_NEAR(at(counts, GroundKind::paving_stones), 1400, 1e-2);
  EXPECT_NEAR(counts.bare_m2, 8000, 1e-2);
  double whole = 0;
  for (const Stored& t : triangles) {
    EXPECT_GE(plan_area(t), -1e-3);  // all face up, or stand
    whole += plan_area(t);
  }
  EXPECT_NEAR(whole, 10'000, 1e-2);
}

TEST(CoverGround, CarriagewaysLieBelowTheSlopeAndAllElseOnIt) {
  Cover cover;
  cover.add(band(2, 40, 46, {GroundKind::asphalt, true, true}));
  cover.finish();
  std::vector<Stored> triangles = make_slope(0.1f);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  double kerb_m2 = 0;
  for (const Stored& t : triangles) {
    const bool sunken = t.material == to_code(GroundKind::asphalt);
    if (t.material == to_code(GroundKind::kerb)) {
      const glm::vec3 normal = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
      kerb_m2 += glm::length(normal) / 2;
      // Towards the carriageway, whose middle is at 43 m north.
      EXPECT_LT(normal.z * (t.corners[0].z < -43 ? -1 : 1), 0);
      continue;
    }
    for (const glm::vec3& corner : t.corners)
      EXPECT_NEAR(corner.y, 0.1 * corner.x - (sunken ? roads::kerb_m : 0), 1e-5);
    EXPECT_EQ(t.feature, sunken ? no_id : relief_feature);
  }
  EXPECT_NEAR(kerb_m2, 2 * 100 * roads::kerb_m, 1e-3);
}

TEST(CoverGround, ALoweredKerbHasTheAreaOfItsProfileAndNoGaps) {
  Cover cover;
  cover.add(band(2, 40, 46, {GroundKind::asphalt, true, true}));
  cover.add(band(1, 36, 50, {GroundKind::paving_stones, false, false}));
  for (ground_cover::RampFacet& facet :
       ground_cover::make_ramp({50, 46}, {1, 0}, {0, 1}, roads::kerb_m - 0.03))
    cover.add_ramp(std::move(facet));
  cover.finish();
  std::vector<Stored> triangles = make_slope(0.1f);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  double kerb_m2 = 0, plan_m2 = 0;
  std::map<std::array<float, 6>, int> sides;  // of edges within the square
  for (const Stored& t : triangles) {
    plan_m2 += plan_area(t);
    if (t.material == to_code(GroundKind::kerb))
      kerb_m2 +=
          glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0])) / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 &a = t.corners[k], &b = t.corners[(k + 1) % 3];
      const auto inner = [](const glm::vec3& p) {
        return p.x > 0.01f && p.x < 99.99f && p.z < -0.01f && p.z > -99.99f;
      };
      if (!inner(a) || !inner(b)) continue;
      ++sides[{a.x, a.y, a.z, b.x, b.y, b.z}];
    }
  }
  // North: 94 m of the whole kerb, 4 m of a low one, and two slopes from the one to the other.
  const double north = 94 * roads::kerb_m + 4 * 0.03 + 2 * (roads::kerb_m + 0.03) / 2;
  EXPECT_NEAR(kerb_m2, 100 * roads::kerb_m + north, 1e-3);
  EXPECT_NEAR(plan_m2, 10'000, 1e-2);
  for (const auto& [edge, count] : sides) {
    const std::array<float, 6> back{edge[3], edge[4], edge[5], edge[0], edge[1], edge[2]};
    EXPECT_TRUE(sides.contains(back)) << edge[0] << ' ' << edge[1] << ' ' << edge[2];
  }
}

// Outlines that cross the ground's border in one place leave slivers there, whose corners are
// rounded to where no triangle of the ground is.
TEST(CoverGround, SliversAtTheGroundsBorderLieInItsPlane) {
  Cover cover;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(2, 98), aside(0.5, 2);
  for (int i = 0; i < 300; ++i) {
    const double middle = along(random);
    std::vector<glm::dvec2> ring{{middle - aside(random), middle + aside(random)},
                                 {middle + aside(random), middle - aside(random)},
                                 {middle + aside(random), middle + aside(random)}};
    for (glm::dvec2& p : ring) p = glm::round(p * 1024.0) / 1024.0;
    cover.add({2 * i, {GroundKind::asphalt, false, false}, {ring}});
    for (glm::dvec2& p : ring) std::swap(p.x, p.y);  // mirrored in the border
    cover.add({2 * i + 1, {GroundKind::paving_stones, false, false}, {ring}});
  }
  cover.finish();
  const Stored slope = make_slope(0.1f)[0];  // its border runs through the strips
  std::vector<Stored> triangles{slope};
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  ASSERT_EQ(counts.uncut_tiles, 0u);
  for (const Stored& t : triangles)
    for (const glm::vec3& corner : t.corners) EXPECT_NEAR(corner.y, 0.1 * corner.x, 1e-4);
}

TEST(CoverGround, NoKerbStandsAcrossAStreetWhereTilesMeetOffTheGridOfOutlines) {
  for (const float border : {50.0f, 49.9996f, 50.0004f, 50.0001f}) {
    Cover cover;
    cover.add(band(2, 40, 46, {GroundKind::asphalt, true, true}));
    cover.finish();
    double kerb_m2 = 0;
    for (const auto& [west, east] : {std::pair(0.0f, border), std::pair(border, 100.0f)}) {
      const glm::vec3 a(west, 0, 0), b(east, 0, 0), c(east, 0, -100), d(west, 0, -100);
      const MaterialCode terrain = to_code(BakeMaterial::terrain);
      std::vector<Stored> tile{{{a, b, c}, terrain, relief_feature, 0},
                               {{a, c, d}, terrain, relief_feature, 0}};
      CoverCounts counts;
      cover_ground(cover, {0, 0, 0}, tile, counts);
      for (const Stored& t : tile)
        if (t.material == to_code(GroundKind::kerb))
          kerb_m2 +=
              glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0])) / 2;
    }
    EXPECT_NEAR(kerb_m2, 2 * 100 * roads::kerb_m, 1e-2) << border;
  }
}

TEST(CoverGround, PaintIsSeenOnCarriagewaysOnly) {
  Cover cover;
  cover.add(band(2, 40, 46, {GroundKind::asphalt, true, true}));
  cover.add_marking({{50, 35}, {51, 35}, {51, 55}, {50, 55}});
  cover.finish();
  std::vector<Stored> triangles = make_slope(0);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  EXPECT_NEAR(at(counts, GroundKind::paint), 6, 1e-3);
  EXPECT_NEAR(at(counts, GroundKind::asphalt), 594, 1e-2);
}

TEST(CoverGround, RailsLieFlushInWhateverLiesThere) {
  Cover cover;
  cover.add(band(2, 40, 46, {GroundKind::asphalt, true, true}));
  cover.add(band(1, 46, 60, {GroundKind::ballast, false, false}));
  cover.add_marking({{50, 41}, {52, 41}, {52, 45}, {50, 45}});
  cover.add_marking({{51, 20}, {51.25, 20}, {51.25, 80}, {51, 80}}, ground_cover::Marking::rail);
  cover.finish();
  std::vector<Stored> triangles = make_slope(0.1f);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  EXPECT_NEAR(at(counts, GroundKind::rail), 0.25 * 60, 1e-3);
  EXPECT_NEAR(at(counts, GroundKind::paint), (2 - 0.25) * 4, 1e-3);
  EXPECT_NEAR(at(counts, GroundKind::ballast), (100 - 0.25) * 14, 1e-2);
  double whole = 0;
  for (const Stored& t : triangles) {
    whole += plan_area(t);
    if (t.material != to_code(GroundKind::rail)) continue;
    EXPECT_EQ(t.feature, no_id);
    const float north = -(t.corners[0].z + t.corners[1].z + t.corners[2].z) / 3;
    const double depth = north > 40 && north < 46 ? roads::kerb_m : 0;
    for (const glm::vec3& corner : t.corners) EXPECT_NEAR(corner.y, 0.1 * corner.x - depth, 1e-5);
  }
  EXPECT_NEAR(whole, 10'000, 1e-2) << "no two surfaces lie in one place";
}

TEST(CoverGround, RailsAloneAreCutIntoBareGround) {
  Cover cover;
  cover.add_marking({{51, 20}, {51.25, 20}, {51.25, 80}, {51, 80}}, ground_cover::Marking::rail);
  cover.add_marking({{60, 20}, {61, 20}, {61, 80}, {60, 80}});
  cover.finish();
  std::vector<Stored> triangles = make_slope(0);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  EXPECT_NEAR(at(counts, GroundKind::rail), 0.25 * 60, 1e-3);
  EXPECT_EQ(at(counts, GroundKind::paint), 0);
  EXPECT_NEAR(counts.bare_m2, 10'000 - 0.25 * 60, 1e-2);
}

TEST(CoverGround, NeighboursShareTheirVertices) {
  Cover cover;
  cover.add(band(1, 30, 50, {GroundKind::grass, false, false}));
  cover.finish();
  std::vector<Stored> triangles = make_slope(0.13f);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  // Every edge inside the square has the same two ends on both sides, to the last bit.
  std::map<std::array<float, 6>, int> sides;
  for (const Stored& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 &a = t.corners[k], &b = t.corners[(k + 1) % 3];
      ++sides[{a.x, a.y, a.z, b.x, b.y, b.z}];
      --sides[{b.x, b.y, b.z, a.x, a.y, a.z}];
    }
  for (const auto& [edge, count] : sides) {
    if (count == 0) continue;
    const auto on_rim = [&](std::size_t i) {
      const float x = edge[i], z = edge[i + 2];
      return x == 0 || x == 100 || z == 0 || z == -100;
    };
    EXPECT_TRUE(on_rim(0) && on_rim(3));
  }
}

TEST(CoverGround, OtherSurfacesStay) {
  Cover cover;
  cover.add(band(1, 30, 50, {GroundKind::grass, false, false}));
  cover.finish();
  std::vector<Stored> triangles = make_slope(0);
  triangles[0].material = to_code(BakeMaterial::water);
  triangles.push_back({{{5, 0, -40}, {6, 0, -40}, {5, 3, -40}},  // upright
                       to_code(BakeMaterial::terrain),
                       relief_feature,
                       0});
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  EXPECT_NEAR(at(counts, GroundKind::grass), 20 * (100 - 60), 800);
  EXPECT_EQ(
      std::count_if(triangles.begin(), triangles.end(),
                    [](const Stored& t) { return t.material == to_code(BakeMaterial::water); }),
      1);
}

TEST(CoverGround, AHostileCoverLeavesTheTileBareAndIsCounted) {
  Cover cover;
  for (int i = 0; i < 400; ++i) {
    const double at_m = i * 0.2;
    cover.add({1,
               {GroundKind::grass, false, false},
               {{{at_m, -10}, {at_m + 0.1, -10}, {at_m + 0.1, 110}, {at_m, 110}}}});
    cover.add(band(2, at_m, at_m + 0.1, {GroundKind::asphalt, true, true}));
  }
  cover.finish();
  std::vector<Stored> triangles = make_slope(0);
  CoverCounts counts;
  cover_ground(cover, {0, 0, 0}, triangles, counts);
  EXPECT_EQ(counts.uncut_tiles, 1u);
  EXPECT_EQ(triangles.size(), 2u);
}

}  // namespace
}  // namespace nightcity::bake
