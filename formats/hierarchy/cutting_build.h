// Builds hierarchies that cut large triangles (spatial_split.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "formats/free_memory.h"
#include "formats/hierarchy/parallel_build.h"
#include "formats/hierarchy/spatial_split.h"
#include "formats/hierarchy/topology.h"
#include "formats/large_vector.h"

namespace nightcity::hierarchy {

/// Pieces of triangles, and the corners of those that may be cut, as append_pieces makes them.
struct CutPieces {
  LargeVector<TrianglePiece> pieces;
  LargeVector<PackedCorners> large;
  float margin_m = 0;  // of their boxes
};

/// Tells the triangles and parts that lie in the leaves of a hierarchy.
struct LeafParts {
  LargeVector<std::uint32_t> order;  // the triangle or part at each position
  std::vector<Cut> cuts;
};

/// Returns how many cuts a hierarchy may make: half as many as it has triangles, where numbers of
/// parts allow that. Room is shared before it is known where it is needed; cities use a third of it.
std::uint32_t find_room(std::size_t triangles);

/// Numbers what lies in the leaves of a build, which name their first pieces before and their first
/// positions after.
class LeafNumbers {
 public:
  /// `made`: all cuts that there was room for. Positions count from `position` on.
  LeafNumbers(std::span<const TrianglePiece> pieces, std::uint32_t triangles,
              std::span<const Cut> made, std::uint32_t position);
  /// Does nothing to a child that is no leaf.
  void take(std::uint32_t& child);
  LeafParts finish() { return std::move(parts_); }

 private:
  std::uint32_t find_number(std::uint32_t part) const;

  std::span<const TrianglePiece> pieces_;
  std::uint32_t triangles_, position_;
  std::vector<std::uint32_t> numbers_;  // of each cut, among those that were made
  LeafParts parts_;
};

/// Appends the nodes of a hierarchy over one piece or more, of so many triangles, whose leaves have
/// at most `max_leaf` and count their positions from `position` on. A ray may defer `stack` entries.
/// The result does not depend on the number of threads. Nodes are as Builder's.
template <class Nodes>
Root build_cutting(CutPieces pieces, std::uint32_t triangles, std::uint32_t max_leaf,
                   std::uint32_t stack, unsigned threads, std::uint32_t position,
                   LargeVector<typename Nodes::Node>& nodes, LeafParts& parts) {
  const std::uint32_t room = find_room(triangles);
  pieces.pieces.resize(pieces.pieces.size() + room);
  std::vector<Cut> made(room, Cut{0, no_axis, 0});
  const std::size_t base = nodes.size();
  Root root = ParallelBuild<CutPieceAccess, Nodes>(
                  std::span(pieces.pieces), max_leaf, threads, nodes,
                  TriangleCuts(pieces.large, triangles, made, pieces.margin_m), room)
                  .build(0, stack);
  free_memory(pieces.large);
  LeafNumbers numbers(pieces.pieces, triangles, made, position);
  numbers.take(root.node);
  for (std::size_t i = base; i < nodes.size(); ++i)
    for (std::uint32_t& child : nodes[i].child) numbers.take(child);
  parts = numbers.finish();
  return root;
}

/// Builds the hierarchy of a file's static triangles, and returns it as numbers. `area_m2` gets half
/// the surfaces of all children's boxes, summed.
Encoded build_encoded(CutPieces pieces, std::uint32_t triangles, unsigned threads, double& area_m2);

}  // namespace nightcity::hierarchy
