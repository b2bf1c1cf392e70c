#include "formats/hierarchy/wall_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nightcity::hierarchy {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;
// Other frames are worth their turn where they take off this share of the air at least.
constexpr double least_gain = 0.1;
// Angles this close to that of the frame are its own: their mean is the frame's direction.
constexpr std::size_t own_bins = 4;

}  // namespace

void WallDirections::add(const Corners& triangle) {
  const Float4 e = triangle.v1 - triangle.v0, f = triangle.v2 - triangle.v0;
  const double x = double(e[1]) * double(f[2]) - double(e[2]) * double(f[1]),
               y = double(e[2]) * double(f[0]) - double(e[0]) * double(f[2]),
               z = double(e[0]) * double(f[1]) - double(e[1]) * double(f[0]);
  const double across = std::hypot(x, z);
  if (!std::isfinite(across) || !(across > 10 * std::abs(y))) return;
  const double angle = std::fmod(std::atan2(z, x) + 4 * quarter_turn, quarter_turn);
  const std::size_t bin = std::min(bins - 1, std::size_t(angle / quarter_turn * double(bins)));
  area_[bin] += across / 2;
  cosine_[bin] += std::cos(4 * angle) * across / 2;
  sine_[bin] += std::sin(4 * angle) * across / 2;
}

// The box of a wall of length l has a plan of l^2 |sin(2 a)| / 2 at an angle a to its axes.
BoxFrame WallDirections::find_frame() const {
  const auto measure_air = [&](std::size_t turned) {
    double air = 0;
    for (std::size_t i = 0; i < bins; ++i)
      air += area_[i] * std::sin(double((i + bins - turned) % bins) * 2 * quarter_turn / bins);
    return air;
  };
  std::size_t best = 0;
  double least = measure_air(0);
  const double unturned = least;
  for (std::size_t turned = 1; turned < bins; ++turned)
    if (const double air = measure_air(turned); air < least) least = air, best = turned;
  if (!(least < (1 - least_gain) * unturned)) return {};
  double cosine = 0, sine = 0;
  for (std::size_t i = 0; i <= 2 * own_bins; ++i) {
    const std::size_t bin = (best + bins + i - own_bins) % bins;
    cosine += cosine_[bin];
    sine += sine_[bin];
  }
  const double angle = std::atan2(sine, cosine) / 4;
  return {{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}};
}

}  // namespace nightcity::hierarchy
