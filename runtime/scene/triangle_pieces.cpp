#include "runtime/scene/triangle_pieces.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "formats/free_memory.h"
#include "formats/parallel.h"

namespace nightcity::scene {
namespace {

using hierarchy::piece_chunk;
using hierarchy::TrianglePiece;

// Pages of the file that triangles are read from are given back after so many chunks.
constexpr std::size_t release_chunks = 64;

// Counts large triangles, which were counted from 0 on, from `first` on.
void number_large(std::vector<TrianglePiece>& pieces, std::uint32_t first) {
  if (first == 0) return;
  for (TrianglePiece& piece : pieces)
    if (piece.is_large())
      piece = TrianglePiece(piece.bounds(), piece.first(), piece.count() + first);
}

}  // namespace

LargeVector<TrianglePiece> make_pieces(const TriangleList& triangles, std::size_t first,
                                       std::size_t count, bool pairs,
                                       const hierarchy::BoxFrame& frame, unsigned threads,
                                       hierarchy::Bounds& box,
                                       LargeVector<hierarchy::PackedCorners>* large) {
  const std::size_t chunks = (count + piece_chunk - 1) / piece_chunk;
  LargeVector<TrianglePiece> pieces;
  pieces.reserve(count);  // room that is not used takes no memory
  std::mutex appending;
  std::vector<std::vector<TrianglePiece>> waiting(chunks);
  std::vector<LargeVector<hierarchy::PackedCorners>> large_waiting(large ? chunks : 0);
  std::size_t next = 0;
  run_parallel(chunks, threads, [&](std::size_t i) {
    const std::size_t begin = i * piece_chunk;
    std::vector<hierarchy::Corners> chunk(std::min(piece_chunk, count - begin));
    triangles.copy_corners(first + begin, chunk);
    if ((i + 1) % release_chunks == 0) triangles.release_pages();
    std::vector<TrianglePiece> made;
    made.reserve(chunk.size());
    hierarchy::append_pieces(chunk, pairs, static_cast<std::uint32_t>(begin), frame, made,
                             large ? &large_waiting[i] : nullptr);
    hierarchy::Bounds of_chunk;
    for (const hierarchy::Corners& triangle : chunk) of_chunk.grow(triangle.bounds());
    const std::lock_guard lock(appending);
    box.grow(of_chunk);
    waiting[i] = std::move(made);
    for (; next < chunks && !waiting[next].empty(); ++next) {
      if (large) {
        number_large(waiting[next], static_cast<std::uint32_t>(large->size()));
        large->insert(large->end(), large_waiting[next].begin(), large_waiting[next].end());
        free_memory(large_waiting[next]);
      }
      pieces.insert(pieces.end(), waiting[next].begin(), waiting[next].end());
      free_memory(waiting[next]);
    }
  });
  return pieces;
}

}  // namespace nightcity::scene
