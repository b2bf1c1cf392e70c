#include "tools/trees/crown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/random.h"

namespace nightcity::trees {
namespace {

TEST(Crown, TheMeanGapOfABallIsTheMeanOverItsChords) {
  for (const double depth : {0.01, 0.5, 2.0, 8.0}) {
    double sum = 0;  // over the disc that the ball shows, ring by ring
    constexpr int rings = 100'000;
    for (int i = 0; i < rings; ++i) {
      const double r2 = (i + 0.5) / rings;  // rings of equal area
      sum += std::exp(-depth * std::sqrt(1 - r2)) / rings;
    }
    EXPECT_NEAR(find_mean_gap(depth), sum, 1e-5);
    EXPECT_NEAR(find_depth(find_mean_gap(depth)), depth, 1e-6);
  }
  EXPECT_EQ(find_mean_gap(0), 1);
}

bool meets(const LeafQuad& leaf, const glm::vec3& from, const glm::vec3& direction) {
  const glm::vec3 u = leaf[1] - leaf[0], v = leaf[3] - leaf[0], n = glm::cross(u, v);
  const float cosine = glm::dot(n, direction);
  if (cosine == 0) return false;
  const glm::vec3 p = from + direction * (glm::dot(n, leaf[0] - from) / cosine) - leaf[0];
  const float a = glm::dot(p, u) / glm::dot(u, u), b = glm::dot(p, v) / glm::dot(v, v);
  return a >= 0 && a <= 1 && b >= 0 && b <= 1;
}

constexpr int rays = 20'000;

// Light through the leaves themselves, from many directions.
double measure_gap(const std::vector<LeafQuad>& leaves) {
  Random random{7};
  int passed = 0;
  for (int i = 0; i < rays; ++i) {
    const double z = random.range(-1, 1), angle = random.range(0, 6.2831853),
                 s = std::sqrt(1 - z * z);
    const glm::vec3 direction(s * std::cos(angle), z, s * std::sin(angle));
    const glm::vec3 across = glm::normalize(
        glm::cross(direction, std::abs(z) < 0.9 ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const glm::vec3 up = glm::cross(direction, across);
    const double r = std::sqrt(random.uniform()), turn = random.range(0, 6.2831853);
    const glm::vec3 from = across * static_cast<float>(r * std::cos(turn)) +
                           up * static_cast<float>(r * std::sin(turn)) - direction * 3.0f;
    passed += std::none_of(leaves.begin(), leaves.end(),
                           [&](const LeafQuad& leaf) { return meets(leaf, from, direction); });
  }
  return double(passed) / rays;
}

TEST(Crown, LightPassesItsLeavesAsItsGapFractionSays) {
  // Leaves of the models' sizes. Five standard deviations of 20,000 rays, and what make_leaves
  // promises: false alarms below 1e-6.
  const auto tolerance = [](double gap) { return 0.001 + 5 * std::sqrt(gap * (1 - gap) / rays); };
  EXPECT_NEAR(measure_gap(make_leaves(gap_with_leaves, 0.2, 0.12, 1)), gap_with_leaves,
              tolerance(gap_with_leaves));
  EXPECT_NEAR(measure_gap(make_leaves(gap_without_leaves, 0.7, 0.05, 1)), gap_without_leaves,
              tolerance(gap_without_leaves));
  EXPECT_NEAR(measure_gap(make_leaves(0.5, 0.1, 0.1, 1)), 0.5, tolerance(0.5));
}

TEST(Crown, SmallLeavesAreAsManyAsTheClosedFormSays) {
  // Leaves of 0.05 radii reach beyond the ball by 1 % of what they cover. The gap of one draw of n
  // leaves is off its mean as if its depth were by 1 / sqrt(n).
  constexpr double size = 0.05;
  for (const double gap : {0.2, 0.5, 0.8}) {
    const double count = 4 * std::numbers::pi / 3 * find_depth(gap) / (size * size);
    const auto leaves = make_leaves(gap, size, size, 3);
    EXPECT_NEAR(static_cast<double>(leaves.size()) / count, 1, 0.03 + 3 / std::sqrt(count)) << gap;
  }
}

TEST(Crown, TheSameSeedGivesTheSameLeaves) {
  const auto one = make_leaves(0.3, 0.2, 0.2, 4), same = make_leaves(0.3, 0.2, 0.2, 4),
             other = make_leaves(0.3, 0.2, 0.2, 5);
  EXPECT_EQ(one, same);
  EXPECT_NE(one, other);
}

}  // namespace
}  // namespace nightcity::trees
