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
  void add(std::uint32_t number, const Box& box);
  /// Returns the numbers of the boxes whose squares meet a rectangle, each once, in order.
  std::vector<std::uint32_t> find(const Box& box) const;

 private:
  static constexpr int levels = 28;
  std::array<bool, levels> used_{};
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares_;
};

}  // namespace nightcity::ground_cover
