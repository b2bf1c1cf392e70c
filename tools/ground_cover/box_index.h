// Finds boxes in the plane that meet a rectangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

namespace nightcity::ground_cover {

using Ring = std::vector<glm::dvec2>;

struct Box {
  glm::dvec2 low, high;
  bool holds(const glm::dvec2& p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
};

/// Returns the box around finite points, of which there is at least one.
Box find_box(const std::vector<std::vector<glm::dvec2>>& rings);

/// A box lies in the squares of the grid that is just wider than it, at most four: so any box costs
/// the same, whatever its size. Coordinates in metres, finite and below 1e9.
class BoxIndex {
 public:
  /// Numbers ascend from call to call.
  void add(std::uint32_t number, const Box& box);
  /// Returns the numbers of the boxes whose squares meet a rectangle, each once, in order.
  std::vector<std::uint32_t> find(const Box& box) const;
  /// Returns the least number that `holds` accepts of the boxes whose squares hold a place, or
  /// `none`. It asks for few of them where numbers were added in order.
  template <class Holds>
  std::uint32_t find_first(const glm::dvec2& place, const Holds& holds) const;

  static constexpr std::uint32_t none = ~std::uint32_t{0};

 private:
  static constexpr int levels = 28;
  // Returns the boxes of a level that lie in the square of a place, null where there are none.
  const std::vector<std::uint32_t>* find_square(const glm::dvec2& place, int level) const;

  std::array<bool, levels> used_{};
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares_;
};

template <class Holds>
std::uint32_t BoxIndex::find_first(const glm::dvec2& place, const Holds& holds) const {
  std::uint32_t first = none;
  for (int level = 0; level < levels; ++level) {
    const std::vector<std::uint32_t>* square = find_square(place, level);
    if (!square) continue;
    for (const std::uint32_t number : *square) {
      if (number >= first) break;  // a square's numbers ascend
      if (!holds(number)) continue;
      first = number;
      break;
    }
  }
  return first;
}

}  // namespace nightcity::ground_cover
