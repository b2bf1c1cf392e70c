#include "runtime/scene/triangle_pieces.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

#include "formats/parallel.h"

namespace nightcity::scene {
namespace {

// Pages of the file that triangles are read from are given back after so many chunks.
constexpr std::size_t release_chunks = 64;
constexpr std::size_t chunk_size = 1 << 12;  // triangles; no pair crosses the end of a chunk

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

// Returns whether two triangles are one piece.
bool make_pair(const gpu::Triangle& a, const gpu::Triangle& b) {
  if (!share_edge(a, b)) return false;
  const Bounds box = bounds_of(a), next = bounds_of(b);
  Bounds both = box;
  both.grow(next);
  return both.half_area() <= box.half_area() + next.half_area();
}

// Appends the pieces of a chunk of triangles, whose numbers count from `number` on.
void append_pieces(std::span<const gpu::Triangle> chunk, bool pairs, std::uint32_t number,
                   std::vector<TrianglePiece>& pieces) {
  for (std::size_t i = 0; i < chunk.size(); ++i, ++number) {
    Bounds box = bounds_of(chunk[i]);
    if (pairs && i + 1 < chunk.size() && make_pair(chunk[i], chunk[i + 1])) {
      box.grow(bounds_of(chunk[++i]));
      pieces.emplace_back(box, number++, 2);
    } else {
      pieces.emplace_back(box, number, 1);
    }
  }
}

}  // namespace

LargeVector<TrianglePiece> make_pieces(const TriangleList& triangles, std::size_t first,
                                       std::size_t count, bool pairs, unsigned threads) {
  const std::size_t chunks = (count + chunk_size - 1) / chunk_size;
  LargeVector<TrianglePiece> pieces;
  pieces.reserve(count);  // room that is not used takes no memory
  std::mutex appending;
  std::vector<std::vector<TrianglePiece>> waiting(chunks);
  std::size_t next = 0;
  run_parallel(chunks, threads, [&](std::size_t i) {
    const std::size_t begin = i * chunk_size;
    std::vector<gpu::Triangle> chunk(std::min(chunk_size, count - begin));
    triangles.copy(first + begin, chunk);
    if ((i + 1) % release_chunks == 0) triangles.release_pages();
    std::vector<TrianglePiece> made;
    made.reserve(chunk.size());
    append_pieces(chunk, pairs, static_cast<std::uint32_t>(begin), made);
    const std::lock_guard lock(appending);
    waiting[i] = std::move(made);
    for (; next < chunks && !waiting[next].empty(); ++next) {
      pieces.insert(pieces.end(), waiting[next].begin(), waiting[next].end());
      waiting[next] = {};
    }
  });
  return pieces;
}

}  // namespace nightcity::scene
