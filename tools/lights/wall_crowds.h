// Finds walls that stand in one place: where many objects are the same, as where one house was
// exported many times, a look at each of their walls from each of their windows would have no end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nightcity::lights {

/// The bits of the numbers that say where a wall is: walls of one place have equal ones.
using WallPlace = std::array<std::uint32_t, 8>;

constexpr std::uint32_t no_crowd = std::numeric_limits<std::uint32_t>::max();

struct WallCrowds {
  struct Kept {
    std::uint32_t wall;              // its number
    std::uint32_t crowd = no_crowd;  // of its place, where more than two owners have walls there
  };
  /// In each place the first wall, and the first one of another owner, in the order of the walls:
  /// whoever owns a window, one of the two is another's, if there is any.
  std::vector<Kept> kept;
  std::vector<std::vector<std::uint32_t>> owners;  // of each crowd, ascending, each once

  /// Returns whether an owner has a wall in the crowd.
  bool holds(std::uint32_t crowd, std::uint32_t owner) const;
  /// Returns how many numbers the members hold.
  std::size_t size() const;
};

/// Both spans are parallel: a wall each.
WallCrowds find_crowds(std::span<const WallPlace> places, std::span<const std::uint32_t> owners);

}  // namespace nightcity::lights
