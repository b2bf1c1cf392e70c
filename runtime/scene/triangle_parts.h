// The parts of triangles that a stored hierarchy cuts (formats/hierarchy/cuts.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/hierarchy/cuts.h"
#include "formats/hierarchy/triangle_pieces.h"
#include "formats/large_vector.h"
#include "runtime/scene/triangle_list.h"

namespace nightcity::scene {

class TriangleParts {
 public:
  /// Measures the parts of the triangles from `first` on, of which there are `count`, in a frame
  /// without its margin. `cuts` are as decode_cuts leaves them. Returns why they are refused, ""
  /// where they are not: a cut that misses its part.
  std::string measure(std::span<const hierarchy::Cut> cuts, const TriangleList& triangles,
                      std::size_t first, std::uint32_t count, const hierarchy::BoxFrame& frame,
                      unsigned threads);

  /// Holds the place of each part in a list, and its box.
  using Found = std::vector<std::pair<std::size_t, hierarchy::Bounds>>;
  /// Puts triangles in the place of their parts, all counted from `first` on, and returns these.
  Found replace(std::span<std::uint32_t> numbers) const;

 private:
  std::uint32_t end_ = 0;  // behind the triangles
  LargeVector<hierarchy::TrianglePiece> parts_;
};

}  // namespace nightcity::scene
