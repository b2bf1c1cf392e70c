// Remembers roughly where lines run, so that what none of them meets need not be cut.
#pragma once

#include <bitset>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/ground_cover/box_index.h"

namespace nightcity::bake {

/// A grid of squares over a rectangle of the plan.
class LineGrid {
 public:
  explicit LineGrid(const ground_cover::Box& box);
  /// Marks the squares near a closed line.
  void add_ring(const std::vector<glm::dvec2>& ring);
  /// Returns whether a line may meet the rectangle: true for all that one meets, and for some that
  /// one passes.
  bool meets(const ground_cover::Box& box) const;

 private:
  static constexpr int side = 256;
  int find_square(double coordinate, int axis) const;
  // Passes squares that meet the box until `visit` returns true, and returns whether it did.
  template <class Visit>
  bool any_square(const ground_cover::Box& box, const Visit& visit) const;

  ground_cover::Box box_;
  glm::dvec2 square_m_;
  std::bitset<side * side> marked_;
};

}  // namespace nightcity::bake
