#include "tools/bake/scene/hidden_surfaces.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <map>

namespace nightcity::bake {
namespace {

using Stored = TileStore::StoredTriangle;

/// Returns a box with outward faces. `turn` selects the diagonals of its quads, so that neighbours
/// are cut differently.
void add_box(std::vector<Stored>& out, const glm::vec3& low, const glm::vec3& high,
             std::uint32_t feature, bool turn = false, bool solid = true) {
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto corner = [&](int k) {
    return glm::vec3(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
  };
  for (const auto& f : faces) {
    const std::size_t k = turn ? 1 : 0;
    out.push_back({{corner(f[k]), corner(f[k + 1]), corner(f[k + 2])}, 0, feature, solid});
    out.push_back({{corner(f[k]), corner(f[k + 2]), corner(f[(k + 3) % 4])}, 0, feature, solid});
  }
}

double area(const Stored& t) {
  return 0.5 *
         double{glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]))};
}

std::map<std::uint32_t, double> hidden_area(const std::vector<Stored>& triangles,
                                            const BelowGround& below, HiddenCounts& counts) {
  const std::vector<bool> hidden = find_hidden_triangles(triangles, below, counts);
  std::map<std::uint32_t, double> result;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (hidden[i]) result[triangles[i].feature] += area(triangles[i]);
  return result;
}

bool nowhere(const glm::vec3&) {
  return false;
}

TEST(HiddenSurfaces, BoxesFaceOutward) {
  std::vector<Stored> box;
  add_box(box, {0, 0, 0}, {2, 3, 4}, 0);
  add_box(box, {0, 0, 0}, {2, 3, 4}, 0, true);
  double volume = 0;
  for (const Stored& t : box)
    volume += double{glm::dot(t.corners[0], glm::cross(t.corners[1], t.corners[2]))} / 6;
  EXPECT_NEAR(volume, 48, 1e-4);
}

TEST(HiddenSurfaces, OfTwoHousesWallToWallBothWallsAreHiddenHoweverTheyAreCut) {
  std::vector<Stored> row;
  add_box(row, {0, 0, 0}, {10, 8, 12}, 1);
  add_box(row, {10, 0, 0}, {20, 8, 12}, 2, true);
  HiddenCounts counts;
  EXPECT_EQ(hidden_area(row, nowhere, counts), (std::map<std::uint32_t, double>{{1, 96}, {2, 96}}));
  EXPECT_EQ(counts.between, 4u);
  EXPECT_EQ(counts.below, 0u);
}

TEST(HiddenSurfaces, AWallTallerThanItsNeighbourStays) {
  std::vector<Stored> row;
  add_box(row, {0, 0, 0}, {10, 8, 12}, 1);
  add_box(row, {10.005f, 0, 0}, {20, 15, 12}, 2);  // half a centimetre apart is together
  HiddenCounts counts;
  EXPECT_EQ(hidden_area(row, nowhere, counts), (std::map<std::uint32_t, double>{{1, 96}}));
}

TEST(HiddenSurfaces, NeitherAGapNorAnOpenNeighbourNorTheOwnHouseHides) {
  for (const int what : {0, 1, 2}) {
    std::vector<Stored> row;
    add_box(row, {0, 0, 0}, {10, 8, 12}, 1);
    add_box(row, {what == 0 ? 10.1f : 10.0f, 0, 0}, {20, 8, 12}, what == 2 ? 1 : 2, false,
            what != 1);
    HiddenCounts counts;
    EXPECT_TRUE(hidden_area(row, nowhere, counts).empty()) << what;
  }
}

TEST(HiddenSurfaces, WhatLiesWhollyBelowTheGroundIsHidden) {
  // The ground: 2 m high but for a pit of 4 m at x = 30, deeper than the cellars.
  const auto below = [](const glm::vec3& p) {
    return p.y < (std::abs(p.x - 30) < 2 ? -10.0f : 2.0f);
  };
  std::vector<Stored> houses;
  add_box(houses, {0, 0, 0}, {10, 1, 10}, 1);     // all of it
  add_box(houses, {100, 0, 0}, {110, 9, 10}, 2);  // its floor
  add_box(houses, {20, 0, 0}, {40, 1, 10}, 3);    // seen from the pit, but for its ends
  HiddenCounts counts;
  EXPECT_EQ(hidden_area(houses, below, counts),
            (std::map<std::uint32_t, double>{{1, 240}, {2, 100}, {3, 20}}));
  EXPECT_EQ(counts.between, 0u);
}

}  // namespace
}  // namespace nightcity::bake
