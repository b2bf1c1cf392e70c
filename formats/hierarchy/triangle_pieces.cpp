#include "formats/hierarchy/triangle_pieces.h"

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

}  // namespace

void append_pieces(std::span<const Corners> chunk, bool pairs, std::uint32_t number,
                   const BoxFrame& frame, std::vector<TrianglePiece>& pieces) {
  for (std::size_t i = 0; i < chunk.size();) {
    Bounds box = frame.bounds_of(chunk[i]);
    std::uint32_t count = 1;
    if (pairs && i + 1 < chunk.size() && share_edge(chunk[i], chunk[i + 1])) {
      const Bounds next = frame.bounds_of(chunk[i + 1]);
      if (is_compact(box, next)) {
        box.grow(next);
        count = 2;
      }
    }
    pieces.emplace_back(box.widened(frame.margin_m), number, count);
    i += count;
    number += count;
  }
}

}  // namespace nightcity::hierarchy
