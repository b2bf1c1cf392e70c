#include "tools/trees/crown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

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

// Light through the leaves themselves, from many directions.
double measure_gap(const std::vector<LeafQuad>& leaves) {
  Random random{7};
  int passed = 0;
  constexpr int rays = 20'000;
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
  // Leaves of the models' sizes. They reach over the ball's edge, where chords are short, by half
  // their size: there it is a little darker outside and lighter inside.
  EXPECT_NEAR(measure_gap(make_leaves(gap_with_leaves, 0.2, 0.12, 1)), gap_with_leaves, 0.02);
  EXPECT_NEAR(measure_gap(make_leaves(gap_without_leaves, 0.7, 0.05, 1)), gap_without_leaves, 0.05);
  // Small leaves leave nothing to the edge.
  EXPECT_NEAR(measure_gap(make_leaves(0.5, 0.1, 0.1, 1)), 0.5, 0.02);
}

TEST(Crown, TheSameSeedGivesTheSameLeaves) {
  const auto one = make_leaves(0.3, 0.2, 0.2, 4), same = make_leaves(0.3, 0.2, 0.2, 4),
             other = make_leaves(0.3, 0.2, 0.2, 5);
  EXPECT_EQ(one, same);
  EXPECT_NE(one, other);
}

}  // namespace
}  // namespace nightcity::trees
