#include "tools/town/hills.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/random.h"

namespace nightcity::town {
namespace {

constexpr double weights[3] = {0.5, 0.3, 0.2};
constexpr double frequencies[3] = {1.0, 1.6, 2.3};
constexpr double max_slope = 0.09;  // of a town's streets

}  // namespace

Hills::Hills(std::uint64_t seed, double relief_m) : relief_m_(std::max(relief_m, 0.0)) {
  // Slope of the sum of waves: relief / 2 * k * sum(weight * frequency). Higher hills become wider,
  // not steeper.
  double slope_per_k = 0;
  for (int i = 0; i < 3; ++i) slope_per_k += relief_m_ / 2 * weights[i] * frequencies[i];
  double k = 2 * std::numbers::pi / 700;
  if (slope_per_k * k > max_slope) k = max_slope / slope_per_k;
  Random random{static_cast<std::int64_t>(seed), 1};
  for (int i = 0; i < 3; ++i) {
    const double angle = random.range(0, 2 * std::numbers::pi);
    wave_[i] = k * frequencies[i] * glm::dvec2(std::cos(angle), std::sin(angle));
    phase_[i] = random.range(0, 2 * std::numbers::pi);
  }
}

double Hills::smooth(const glm::dvec2& p) const {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += weights[i] * std::sin(glm::dot(wave_[i], p) + phase_[i]);
  return base_m_ + relief_m_ / 2 * sum;
}

double Hills::height(const glm::dvec2& p) const {
  const glm::dvec2 cell = glm::floor(p / spacing_m);
  const glm::dvec2 f = p / spacing_m - cell;
  const auto corner = [&](double x, double y) {
    return smooth((cell + glm::dvec2(x, y)) * spacing_m);
  };
  // Each square is cut from its south-west to its north-east corner.
  const double z00 = corner(0, 0), z11 = corner(1, 1);
  if (f.x >= f.y) {
    const double z10 = corner(1, 0);
    return z00 + f.x * (z10 - z00) + f.y * (z11 - z10);
  }
  const double z01 = corner(0, 1);
  return z00 + f.y * (z01 - z00) + f.x * (z11 - z01);
}

}  // namespace nightcity::town
