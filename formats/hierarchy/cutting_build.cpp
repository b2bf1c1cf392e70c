#include "formats/hierarchy/cutting_build.h"

#include <algorithm>
#include <utility>

#include "formats/hierarchy/spatial_split.h"
#include "formats/hierarchy/static_geometry.h"

namespace nightcity::hierarchy {
namespace {

// Numbers the cuts that were made one after another, and returns the new number of each part.
class PartNumbers {
 public:
  PartNumbers(std::uint32_t triangles, std::span<const Cut> all) : triangles_(triangles) {
    numbers_.reserve(all.size());
    for (const Cut& cut : all) {
      numbers_.push_back(static_cast<std::uint32_t>(cuts_.size()));
      if (cut.axis == no_axis) continue;
      Cut& made = cuts_.emplace_back(cut);
      made.part = find(cut.part) & part_mask;
    }
  }
  std::uint32_t find(std::uint32_t part) const {
    if (part < triangles_) return part;
    const std::uint32_t of_cuts = part - triangles_;
    return triangles_ + 2 * numbers_[of_cuts / 2] + of_cuts % 2;
  }
  std::vector<Cut> take_cuts() { return std::move(cuts_); }

 private:
  std::uint32_t triangles_;
  std::vector<std::uint32_t> numbers_;  // of each cut, among those that were made
  std::vector<Cut> cuts_;
};

// Returns the triangle or part at each position of the leaves, which name their first pieces before
// and their first positions after.
LargeVector<std::uint32_t> find_order(std::span<const TrianglePiece> pieces,
                                      const PartNumbers& numbers, std::uint32_t positions,
                                      LargeVector<BareNode>& nodes, std::uint32_t& root) {
  LargeVector<std::uint32_t> order;
  order.reserve(positions);
  const auto take = [&](std::uint32_t& child) {
    if (child == no_child || !is_leaf(child)) return;
    const auto first = static_cast<std::uint32_t>(order.size());
    const std::uint32_t size = size_of_leaf(child);
    for (std::size_t i = first_of_leaf(child); order.size() < first + size; ++i)
      if (pieces[i].is_large())
        order.push_back(numbers.find(pieces[i].first()));
      else
        for (std::uint32_t k = 0; k < pieces[i].count(); ++k)
          order.push_back(pieces[i].first() + k);
    child = make_leaf(first, size);
  };
  take(root);
  for (BareNode& node : nodes)
    for (std::uint32_t& child : node.child) take(child);
  return order;
}

}  // namespace

std::uint32_t find_room(std::size_t triangles) {
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(triangles / 2, (most_parts - triangles) / 2));
}

Encoded build_with_cuts(CutPieces pieces, std::uint32_t triangles, unsigned threads,
                        double& area_m2) {
  const std::uint32_t room = find_room(triangles);
  pieces.pieces.resize(pieces.pieces.size() + room);
  std::vector<Cut> cuts(room, Cut{0, no_axis, 0});
  LargeVector<BareNode> nodes;
  Root root = ParallelBuild<CutPieceAccess, BareNodes>(
                  std::span(pieces.pieces), static_leaf, threads, nodes,
                  TriangleCuts(pieces.large, triangles, cuts), room)
                  .build(0, static_stack);
  pieces.large = {};
  PartNumbers numbers(triangles, cuts);
  std::vector<Cut> made = numbers.take_cuts();
  const LargeVector<std::uint32_t> order =
      find_order(pieces.pieces, numbers, triangles + static_cast<std::uint32_t>(made.size()), nodes,
                 root.node);
  pieces.pieces = {};
  area_m2 = 0;
  for (const BareNode& node : nodes) area_m2 += double(node.area);
  Encoded encoded = encode(nodes, root.node, order);
  encoded.cuts = std::move(made);
  return encoded;
}

}  // namespace nightcity::hierarchy
