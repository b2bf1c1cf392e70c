#include "tools/trees/crown.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/random.h"
#include "tools/trees/crown_gap.h"

namespace nightcity::trees {
namespace {

// A direction that is as likely as any other (Marsaglia 1972: by height and azimuth).
glm::vec3 draw_direction(Random& random) {
  const double z = random.range(-1, 1), azimuth = random.range(0, 2 * std::numbers::pi),
               r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(azimuth), z, r * std::sin(azimuth)};
}

}  // namespace

double find_mean_gap(double depth) {
  if (depth < 1e-4) return 1 - 2 * depth / 3;  // where the difference below has no digits left
  return 2 * (1 - (1 + depth) * std::exp(-depth)) / (depth * depth);
}

double find_depth(double gap) {
  double low = 0, high = 1e4;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (find_mean_gap(middle) > gap ? low : high) = middle;
  }
  return low;
}

std::vector<LeafQuad> make_leaves(double gap, double length, double width, std::uint64_t seed) {
  const double count = 4.0 / 3 * std::numbers::pi * find_depth(gap) / (length * width);
  Random random{static_cast<std::int64_t>(seed)};
  // More than are needed.
  std::vector<LeafQuad> leaves(64 + static_cast<std::size_t>(std::lround(2 * count)));
  for (LeafQuad& leaf : leaves) {
    const auto middle = draw_direction(random) * static_cast<float>(std::cbrt(random.uniform()));
    const glm::vec3 normal = draw_direction(random);
    const glm::vec3 across = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 s = glm::normalize(glm::cross(normal, across)), t = glm::cross(normal, s);
    const double turn = random.range(0, 2 * std::numbers::pi);
    const auto c = static_cast<float>(std::cos(turn)), d = static_cast<float>(std::sin(turn));
    const glm::vec3 u = (c * s + d * t) * static_cast<float>(length / 2),
                    v = (c * t - d * s) * static_cast<float>(width / 2);
    leaf = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  }
  leaves.resize(count_leaves(leaves, gap));
  return leaves;
}

}  // namespace nightcity::trees
