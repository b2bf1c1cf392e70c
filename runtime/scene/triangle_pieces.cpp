#include "runtime/scene/triangle_pieces.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "formats/parallel.h"

namespace nightcity::scene {
namespace {

constexpr std::size_t chunk_size = 1 << 15;  // triangles; no pair crosses the end of a chunk

Bounds bounds_of(const gpu::Triangle& triangle) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&triangle);
  const Float4 v0 = load_vec3(bytes), v1 = load_vec3(bytes + offsetof(gpu::Triangle, v1)),
               v2 = load_vec3(bytes + offsetof(gpu::Triangle, v2));
  return {min_of(min_of(v0, v1), v2), max_of(max_of(v0, v1), v2)};
}

bool share_edge(const gpu::Triangle& a, const gpu::Triangle& b) {
  int shared = 0;
  for (const glm::vec3* corner : {&a.v0, &a.v1, &a.v2})
    shared += *corner == b.v0 || *corner == b.v1 || *corner == b.v2;
  return shared >= 2;
}

// Writes the pieces of the triangles from `begin` to `end` to `to`, and returns how many they are.
std::size_t add_pieces(std::span<const gpu::Triangle> triangles, std::size_t begin, std::size_t end,
                       bool pairs, TrianglePiece* to) {
  TrianglePiece* const start = to;
  for (std::size_t i = begin; i < end; ++i) {
    const auto first = static_cast<std::uint32_t>(i);
    Bounds box = bounds_of(triangles[i]);
    if (pairs && i + 1 < end && share_edge(triangles[i], triangles[i + 1])) {
      const Bounds next = bounds_of(triangles[i + 1]);
      Bounds both = box;
      both.grow(next);
      if (both.half_area() <= box.half_area() + next.half_area()) {
        *to++ = TrianglePiece(both, first, 2);
        ++i;
        continue;
      }
    }
    *to++ = TrianglePiece(box, first, 1);
  }
  return static_cast<std::size_t>(to - start);
}

}  // namespace

LargeVector<TrianglePiece> make_pieces(std::span<const gpu::Triangle> triangles, bool pairs,
                                       unsigned threads) {
  const std::size_t chunks = (triangles.size() + chunk_size - 1) / chunk_size;
  LargeVector<TrianglePiece> pieces(triangles.size());
  std::vector<std::size_t> count(chunks);
  run_parallel(chunks, threads, [&](std::size_t i) {
    const std::size_t begin = i * chunk_size;
    count[i] = add_pieces(triangles, begin, std::min(begin + chunk_size, triangles.size()), pairs,
                          &pieces[begin]);
  });
  auto end = pieces.begin();
  for (std::size_t i = 0; i < chunks; ++i) {
    const auto from = pieces.begin() + static_cast<std::ptrdiff_t>(i * chunk_size);
    end = std::copy(from, from + static_cast<std::ptrdiff_t>(count[i]), end);
  }
  pieces.erase(end, pieces.end());
  return pieces;
}

}  // namespace nightcity::scene
