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

// Returns whether two triangles are one piece.
bool make_pair(const Corners& a, const Corners& b) {
  if (!share_edge(a, b)) return false;
  const Bounds box = a.bounds(), next = b.bounds();
  Bounds both = box;
  both.grow(next);
  return both.half_area() <= box.half_area() + next.half_area();
}

}  // namespace

void append_pieces(std::span<const Corners> chunk, bool pairs, std::uint32_t number,
                   std::vector<TrianglePiece>& pieces) {
  for (std::size_t i = 0; i < chunk.size(); ++i, ++number) {
    Bounds box = chunk[i].bounds();
    if (pairs && i + 1 < chunk.size() && make_pair(chunk[i], chunk[i + 1])) {
      box.grow(chunk[++i].bounds());
      pieces.emplace_back(box, number++, 2);
    } else {
      pieces.emplace_back(box, number, 1);
    }
  }
}

}  // namespace nightcity::hierarchy
