#include "tools/terrain/ground_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "support/temp_folder.h"
#include "tools/terrain/surface_store.h"

namespace nightcity::terrain {
namespace {

TEST(GroundPoints, KeepsAllUpToItsLimitAndTheLowestOfEachSquareBeyond) {
  GroundPoints points(1000);
  for (int i = 0; i < 900; ++i) points.add({i, 0, i % 7});
  EXPECT_EQ(points.points().size(), 900u);
  EXPECT_EQ(points.spacing_m(), 0);
  std::map<std::pair<double, double>, double> lowest;
  for (int i = 0; i < 100'000; ++i) points.add({i % 300, i / 300, 10 + i % 5});
  EXPECT_LE(points.points().size(), 1000u);
  EXPECT_GT(points.points().size(), 100u);
  const double spacing = points.spacing_m();
  EXPECT_GE(spacing, 8);
  const auto cell = [spacing](double x, double y) {
    return std::make_pair(std::floor(x / spacing), std::floor(y / spacing));
  };
  const auto lower = [&](double x, double y, double z) {
    const auto [at, fresh] = lowest.try_emplace(cell(x, y), z);
    if (!fresh) at->second = std::min(at->second, z);
  };
  for (int i = 0; i < 900; ++i) lower(i, 0, i % 7);
  for (int i = 0; i < 100'000; ++i) lower(i % 300, i / 300, 10 + i % 5);
  std::map<std::pair<double, double>, double> kept;
  for (const glm::dvec3& p : points.points()) {
    const auto [at, fresh] = kept.try_emplace(cell(p.x, p.y), p.z);
    if (!fresh) at->second = std::min(at->second, p.z);
  }
  EXPECT_EQ(kept, lowest) << "every square keeps its lowest point";
  points.add({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  for (const glm::dvec3& p : points.points()) EXPECT_TRUE(std::isfinite(p.x));
}

TEST(SurfaceStore, LooksAtATriangleOnceHoweverOftenItIsThere) {
  const test::TempFolder folder;
  SurfaceStore store(folder / "x");
  for (int n = 0; n < 10'000; ++n) {
    store.add({0, 0, 5}, {10, 0, 5}, {0, 10, 25});  // 5 + 2 y
    store.add({0, 0, 7}, {10, 0, 7}, {0, 10, 7});
  }
  EXPECT_EQ(store.highest_at({2, 0.5}), 7);
  EXPECT_NEAR(store.highest_at({2, 4}).value(), 13, 1e-9);
  EXPECT_EQ(store.highest_at({-1, 4}), std::nullopt);
  EXPECT_EQ(store.count_candidates({2, 0.5}), 2u);
  EXPECT_EQ(store.count_candidates({2, 4}), 1u) << "the other is lower everywhere";
}

// Stacked roofs, of which each covers most of its cell.
TEST(SurfaceStore, LooksAtTheHighestOfAStackAlone) {
  const test::TempFolder folder;
  SurfaceStore store(folder / "x");
  constexpr int layers = 5000;
  for (int n = 0; n < layers; ++n) {
    const double z = (n * 7919) % layers, aside = 0.001 * n;  // in any order
    store.add({aside, 0, z}, {aside + 120, 0, z}, {aside, 120, z});
  }
  EXPECT_EQ(store.highest_at({40, 40}), layers - 1);
  EXPECT_LE(store.count_candidates({40, 40}), 4u);
  EXPECT_EQ(store.highest_at({-5, 40}), std::nullopt);
}

// Beyond its edges, within their tolerance, a steep triangle is higher than its corners.
TEST(SurfaceStore, FindsSteepTrianglesThatRiseAboveTheirCornersAtTheEdge) {
  const test::TempFolder folder;
  SurfaceStore store(folder / "x");
  store.add({0, 0, 0}, {0.01, 0, 100}, {0, 10, 0});  // rises eastward, 10 km a metre
  store.add({-5, -5, 100.001}, {5, -5, 100.001}, {0, 5, 100.001});
  EXPECT_GT(store.highest_at({0.0100005, 0}).value(), 100.004);
  EXPECT_EQ(store.highest_at({0.009, 0}), 100.001);
}

// Beside thousands of roofs that differ by less than a millimetre, none of them is looked at.
TEST(SurfaceStore, LooksAtNoneOfACrowdBesideIt) {
  const test::TempFolder folder;
  SurfaceStore store(folder / "x");
  for (int n = 0; n < 5000; ++n) {
    const double aside = 1e-7 * ((n * 7919) % 5000), z = 1e-7 * n;
    store.add({aside, 0, z}, {aside + 10, 0, z}, {aside + 10, 10, z});
  }
  EXPECT_EQ(store.count_candidates({10.3, 5}), 0u);
  EXPECT_EQ(store.highest_at({10.3, 5}), std::nullopt);
  EXPECT_NEAR(store.highest_at({9, 5}).value(), 1e-7 * 4999, 1e-12);
}

// A brute-force search is the oracle, for triangles of 1 to 10^`magnitude` metres in a square of
// `side_m`.
void expect_what_brute_force_finds(double side_m, double magnitude) {
  const test::TempFolder folder;
  SurfaceStore store(folder / "x");
  std::vector<std::array<glm::dvec3, 3>> all;
  unsigned state = 1;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0;
  };
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10.0, random() * magnitude);
    const glm::dvec3 at(412000 + random() * side_m, 5762000 + random() * side_m, random() * 50);
    const auto corner = [&] {
      return at + glm::dvec3(random() * size, random() * size, random() * 10);
    };
    all.push_back({corner(), corner(), corner()});
    store.add(all.back()[0], all.back()[1], all.back()[2]);
  }
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 p(412000 + random() * side_m * 1.2, 5762000 + random() * side_m * 1.2);
    double best = -1;
    for (const auto& [a, b, c] : all) {
      const auto cross = [](const glm::dvec3& u, const glm::dvec3& v) {
        return u.x * v.y - u.y * v.x;
      };
      const glm::dvec3 q(p, 0);
      const double whole = cross(b - a, c - a), s = cross(q - a, c - a) / whole,
                   t = cross(b - a, q - a) / whole;
      if (s >= 0 && t >= 0 && s + t <= 1)
        best = std::max(best, a.z + s * (b.z - a.z) + t * (c.z - a.z));
    }
    const auto found = store.highest_at(p);
    EXPECT_EQ(found.has_value(), best >= 0);
    if (found) {
      EXPECT_NEAR(*found, best, 1e-6);
    }
  }
  EXPECT_FALSE(store.highest_at({0, 0}));
}

TEST(SurfaceStore, FindsWhatABruteForceSearchFinds) {
  expect_what_brute_force_finds(3000, 3.5);
}

TEST(SurfaceStore, FindsWhatABruteForceSearchFindsInACrowd) {
  expect_what_brute_force_finds(12, 1);
}

}  // namespace
}  // namespace nightcity::terrain
