// A BVH over triangles is built of single triangles and of pairs that share an edge. Walls, windows
// and streets are quads for the most part, so pairs halve the work.
#pragma once

#include <bit>
#include <cstdint>

#include "runtime/scene/bounds.h"
#include "runtime/scene/large_vector.h"
#include "runtime/scene/triangle_list.h"
#include "shaders/bvh_types.h"

namespace nightcity::scene {

/// One or two consecutive triangles, as their box. Their numbers are in its unused fourth places.
class TrianglePiece {
 public:
  TrianglePiece() = default;
  TrianglePiece(const Bounds& box, std::uint32_t first, std::uint32_t count)
      : lower_(put(box.lower, first)), upper_(put(box.upper, count)) {}

  Bounds bounds() const { return {take_xyz(lower_), take_xyz(upper_)}; }
  std::uint32_t first() const { return static_cast<std::uint32_t>(lower_[3]); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(upper_[3]); }

 private:
  static Int4 put(Float4 xyz, std::uint32_t number) {
    Int4 bits = std::bit_cast<Int4>(xyz);
    bits[3] = static_cast<int>(number);
    return bits;
  }
  Int4 lower_, upper_;
};

/// Returns the pieces of `count` triangles from `first` on, in their order; numbers count from
/// `first` on. With `pairs`, two triangles that follow each
/// other are one piece where they share an edge and their common box is no larger than both boxes
/// together.
LargeVector<TrianglePiece> make_pieces(const TriangleList& triangles, std::size_t first,
                                       std::size_t count, bool pairs, unsigned threads);

}  // namespace nightcity::scene
