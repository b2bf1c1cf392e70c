// A grid of places, to ask which of them lie near another.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <utility>
#include <vector>

namespace nightcity::trees {

class NeighbourGrid {
 public:
  explicit NeighbourGrid(double distance_m) : distance_m_(distance_m) {}

  /// Adds a place, which must be finite.
  void add(const glm::dvec2& place) { squares_[find_square(place)].push_back(place); }
  /// Returns whether a place of the grid lies nearer to `place` than the grid's distance.
  bool has_neighbour(const glm::dvec2& place) const;

 private:
  using Square = std::pair<std::int64_t, std::int64_t>;
  Square find_square(const glm::dvec2& place) const;

  double distance_m_;
  std::map<Square, std::vector<glm::dvec2>> squares_;
};

}  // namespace nightcity::trees
