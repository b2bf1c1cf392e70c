#include "formats/hierarchy/triangle_pieces.h"

#include <algorithm>

namespace nightcity::hierarchy {
namespace {

bool is_same_place(Float4 a, Float4 b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

bool share_edge(const Corners& a, const Corners& b) {
  int shared = 0;
  for (const Float4& corner : {a.v0, a.v1, a.v2})
    shared +=
        is_same_place(corner, b.v0) || is_same_place(corner, b.v1) || is_same_place(corner, b.v2);
  return shared >= 2;
}

// Returns whether the box of two triangles is no larger than both of their boxes together.
bool is_compact(const Bounds& a, const Bounds& b) {
  Bounds both = a;
  both.grow(b);
  return both.half_area() <= a.half_area() + b.half_area();
}

bool is_large(const Bounds& box) {
  const Float4 size = box.upper - box.lower;
  return std::max({size[0], size[1], size[2]}) >= min_cut_m;
}

}  // namespace

void append_pieces(std::span<const Corners> chunk, bool pairs, std::uint32_t number,
                   const BoxFrame& frame, std::vector<TrianglePiece>& pieces,
                   LargeVector<PackedCorners>* large) {
  for (std::size_t i = 0; i < chunk.size();) {
    Bounds box = frame.bounds_of(chunk[i]);
    std::uint32_t count = 1, mark = 0;
    if (large && is_large(box)) {
      mark = TrianglePiece::large_bit | static_cast<std::uint32_t>(large->size());
      large->emplace_back(frame.turn(chunk[i]));
    } else if (pairs && i + 1 < chunk.size() && share_edge(chunk[i], chunk[i + 1])) {
      const Bounds next = frame.bounds_of(chunk[i + 1]);
      if (is_compact(box, next) && !(large && is_large(next))) {
        box.grow(next);
        count = 2;
      }
    }
    pieces.emplace_back(box.widened(frame.margin_m), number, mark != 0 ? mark : count);
    i += count;
    number += count;
  }
}

}  // namespace nightcity::hierarchy
