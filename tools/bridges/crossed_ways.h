// Finds the streets, paths and tracks that a bridge crosses, by their places in the plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/bridges/chains.h"
#include "tools/ground_cover/box_index.h"

namespace nightcity::bridges {

/// A place where a chain crosses a way in the plane.
struct Crossing {
  std::size_t way;      // into the ways
  std::size_t segment;  // of that way, by its first point
  double at_m, half_m;  // along the chain: its middle, and half its length there
  glm::dvec2 place;
};

class CrossedWays {
 public:
  /// `ways` must outlive it.
  explicit CrossedWays(std::span<const PlacedWay> ways);
  /// Returns the crossings of a chain with ways that do not meet it at a node there, in order.
  std::vector<Crossing> find(const Chain& chain) const;

 private:
  struct Segment {
    std::uint32_t way, first;  // the way, and the point that it begins at
  };
  std::span<const PlacedWay> ways_;
  std::vector<Segment> segments_;
  ground_cover::BoxIndex index_;
};

}  // namespace nightcity::bridges
