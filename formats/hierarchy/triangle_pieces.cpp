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

// Returns whether two triangles are one piece, whose boxes these are.
bool make_pair(const Corners& a, const Corners& b, const Bounds& of_a, const Bounds& of_b) {
  if (!share_edge(a, b)) return false;
  Bounds both = of_a;
  both.grow(of_b);
  return both.half_area() <= of_a.half_area() + of_b.half_area();
}

}  // namespace

void append_pieces(std::span<const Corners> chunk, bool pairs, std::uint32_t number,
                   const BoxFrame& frame, std::vector<TrianglePiece>& pieces) {
  for (std::size_t i = 0; i < chunk.size();) {
    Bounds box = frame.bounds_of(chunk[i]);
    std::uint32_t count = 1;
    if (pairs && i + 1 < chunk.size()) {
      const Bounds next = frame.bounds_of(chunk[i + 1]);
      if (make_pair(chunk[i], chunk[i + 1], box, next)) {
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
