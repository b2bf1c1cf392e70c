// Finds the direction that most walls of a city follow.
#pragma once

#include <array>
#include <cstddef>

#include "formats/hierarchy/box_frame.h"

namespace nightcity::hierarchy {

class WallDirections {
 public:
  /// Counts a triangle, where it stands upright.
  void add(const Corners& triangle);
  /// Returns the frame, without margin, in which boxes of the walls hold the least air. It is that
  /// of the scene itself where boxes there hold hardly more.
  BoxFrame find_frame() const;

 private:
  static constexpr std::size_t bins = 360;  // of a quarter turn: a wall's faces have the same boxes
  std::array<double, bins> area_{};         // of walls, m2
  // Sums of area times cosine and sine of four times the angle, which faces of a wall share.
  std::array<double, bins> cosine_{}, sine_{};
};

}  // namespace nightcity::hierarchy
