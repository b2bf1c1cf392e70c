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

// Returns whether two triangles are one piece.
bool make_pair(const gpu::Triangle& a, const gpu::Triangle& b) {
  if (!share_edge(a, b)) return false;
  const Bounds box = bounds_of(a), next = bounds_of(b);
  Bounds both = box;
  both.grow(next);
  return both.half_area() <= box.half_area() + next.half_area();
}

struct Chunk {
  std::size_t begin, end;  // triangles
};

// Notes for each triangle of a chunk whether it is the first of a pair, and returns the number of
// pieces.
std::size_t find_pairs(std::span<const gpu::Triangle> triangles, const Chunk& chunk,
                       std::span<std::uint8_t> begins_pair) {
  std::size_t pieces = 0;
  for (std::size_t i = chunk.begin; i < chunk.end; ++i, ++pieces) {
    const bool pair = i + 1 < chunk.end && make_pair(triangles[i], triangles[i + 1]);
    begins_pair[i] = pair;
    i += pair ? 1 : 0;
  }
  return pieces;
}

void write_pieces(std::span<const gpu::Triangle> triangles, const Chunk& chunk,
                  std::span<const std::uint8_t> begins_pair, TrianglePiece* to) {
  for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
    const auto first = static_cast<std::uint32_t>(i);
    Bounds box = bounds_of(triangles[i]);
    if (!begins_pair.empty() && begins_pair[i] != 0) {
      box.grow(bounds_of(triangles[++i]));
      *to++ = TrianglePiece(box, first, 2);
    } else {
      *to++ = TrianglePiece(box, first, 1);
    }
  }
}

}  // namespace

LargeVector<TrianglePiece> make_pieces(std::span<const gpu::Triangle> triangles, bool pairs,
                                       unsigned threads) {
  const std::size_t chunks = (triangles.size() + chunk_size - 1) / chunk_size;
  const auto chunk = [&](std::size_t i) {
    return Chunk{i * chunk_size, std::min((i + 1) * chunk_size, triangles.size())};
  };
  // The first piece of each chunk: pieces are counted first, so that no memory is taken for more.
  std::vector<std::size_t> from(chunks + 1);
  LargeVector<std::uint8_t> begins_pair(pairs ? triangles.size() : 0);
  run_parallel(chunks, threads, [&](std::size_t i) {
    const Chunk c = chunk(i);
    from[i + 1] = pairs ? find_pairs(triangles, c, begins_pair) : c.end - c.begin;
  });
  for (std::size_t i = 0; i < chunks; ++i) from[i + 1] += from[i];
  LargeVector<TrianglePiece> pieces(from[chunks]);
  run_parallel(chunks, threads, [&](std::size_t i) {
    write_pieces(triangles, chunk(i), begins_pair, pieces.data() + from[i]);
  });
  return pieces;
}

}  // namespace nightcity::scene
