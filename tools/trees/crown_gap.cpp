#include "tools/trees/crown_gap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace nightcity::trees {
namespace {

// Rays of a direction are on a grid of this many a side, of which the disc holds pi / 4: 200,000 in
// all. The gap of a crown is off its mean over all rays by less than 0.1 %.
constexpr int side = 64, directions = 64;

// Returns the k-th of `directions` places that are spread evenly over the sphere (a spiral of the
// golden angle: R. Swinbank and R. J. Purser, Q. J. R. Meteorol. Soc. 132, 2006).
glm::dvec3 find_direction(int k) {
  const double z = 1 - (2 * k + 1.0) / directions, r = std::sqrt(1 - z * z),
               turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
  return {r * std::cos(turn), z, r * std::sin(turn)};
}

// The disc of a direction, as squares with one ray each.
class Disc {
 public:
  Disc(const glm::dvec3& direction, std::uint32_t none)
      : u_(glm::normalize(glm::cross(
            direction, std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)))),
        v_(glm::cross(direction, u_)),
        none_(none),
        first_(std::size_t{side} * side, none) {}

  // Numbers ascend from call to call, so that a ray which has a leaf needs no other.
  void add(const LeafQuad& leaf, std::uint32_t number) {
    const glm::dvec2 corner = project(leaf[0]), a = project(leaf[1]) - corner,
                     b = project(leaf[3]) - corner;
    const double area = a.x * b.y - a.y * b.x;
    if (area == 0) return;
    const glm::dvec2 middle = corner + (a + b) / 2.0, reach = (glm::abs(a) + glm::abs(b)) / 2.0;
    const int left = to_square(middle.x - reach.x), right = to_square(middle.x + reach.x),
              top = to_square(middle.y + reach.y);
    for (int row = to_square(middle.y - reach.y); row <= top; ++row)
      for (int column = left; column <= right; ++column) {
        std::uint32_t& first = first_[static_cast<std::size_t>(row * side + column)];
        if (first != none_) continue;
        const glm::dvec2 p = find_ray(column, row) - corner;
        const double along_a = (p.x * b.y - p.y * b.x) / area,
                     along_b = (a.x * p.y - a.y * p.x) / area;
        if (along_a < 0 || along_a > 1 || along_b < 0 || along_b > 1) continue;
        first = number;
      }
  }

  void take(std::vector<std::uint32_t>& out) const {
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        if (glm::length(find_ray(column, row)) < 1)
          out.push_back(first_[static_cast<std::size_t>(row * side + column)]);
  }

 private:
  glm::dvec2 project(const glm::vec3& p) const {
    return {glm::dot(glm::dvec3(p), u_), glm::dot(glm::dvec3(p), v_)};
  }
  static glm::dvec2 find_ray(int column, int row) {
    return (glm::dvec2(column, row) + 0.5) * (2.0 / side) - 1.0;
  }
  static int to_square(double coordinate) {
    return static_cast<int>(std::clamp((coordinate + 1) * (side / 2.0), 0.0, side - 1.0));
  }

  glm::dvec3 u_, v_;
  std::uint32_t none_;
  std::vector<std::uint32_t> first_;  // of each square
};

}  // namespace

std::vector<std::uint32_t> find_first_leaves(std::span<const LeafQuad> leaves) {
  std::vector<std::uint32_t> found;
  for (int k = 0; k < directions; ++k) {
    Disc disc(find_direction(k), static_cast<std::uint32_t>(leaves.size()));
    for (std::uint32_t i = 0; i < leaves.size(); ++i) disc.add(leaves[i], i);
    disc.take(found);
  }
  return found;
}

std::size_t count_leaves(std::span<const LeafQuad> leaves, double gap) {
  std::vector<std::uint32_t> first = find_first_leaves(leaves);
  const auto passing = static_cast<std::size_t>(gap * static_cast<double>(first.size()));
  const auto last =
      first.end() - 1 - static_cast<std::ptrdiff_t>(std::min(passing, first.size() - 1));
  std::nth_element(first.begin(), last, first.end());
  return std::min<std::size_t>(*last + 1, leaves.size());
}

}  // namespace nightcity::trees
