#include "runtime/scene/bvh.h"

#include "formats/error.h"
#include "formats/hierarchy/cutting_build.h"
#include "formats/hierarchy/parallel_build.h"
#include "runtime/scene/quantised_nodes.h"
#include "runtime/scene/triangle_pieces.h"

namespace nightcity::scene {
namespace {

using hierarchy::Bounds;
using hierarchy::PieceAccess;
using hierarchy::TrianglePiece;

static_assert(hierarchy::no_child == BVH_EMPTY && hierarchy::leaf_bit == BVH_LEAF &&
              hierarchy::leaf_count_shift == BVH_LEAF_COUNT_SHIFT &&
              hierarchy::leaf_first_mask == BVH_LEAF_FIRST_MASK);

// Primitives that are only boxes: instances.
struct BoxAccess {
  struct Primitive {
    Bounds box;
    std::uint32_t index, mask;
  };
  using Cuts = hierarchy::NoCuts;
  static constexpr std::uint32_t max_weight = 1;
  static std::uint32_t weight_of(const Primitive&) { return 1; }
  static Bounds bounds_of(const Primitive& p) { return p.box; }
  static std::uint32_t mask_of(const Primitive& p) { return p.mask; }
  static bool casts_shadow(const Primitive& p) { return (p.mask & MASK_SHADOW) != 0; }
  static bool precedes(const Primitive& a, const Primitive& b) { return a.index < b.index; }
};

template <class Access>
using Build = hierarchy::ParallelBuild<Access, QuantisedNodes>;

void check_sizes(std::size_t count, std::uint32_t max_leaf, std::uint32_t max_stack) {
  check_triangle_count(count);
  if (needed_stack(count, max_leaf) > max_stack)
    throw Error(
        "", "the scene has too many triangles in a mesh, or instances, for the traversal stack");
}

}  // namespace

void check_triangle_count(std::size_t count) {
  if (count > BVH_LEAF_FIRST_MASK) throw Error("", "more than 134 million triangles in one scene");
}

std::uint32_t needed_stack(std::size_t boxes, std::uint32_t max_leaf) {
  return hierarchy::find_needed_stack(boxes, max_leaf);
}

Bvh build_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t max_stack,
              std::span<const std::uint8_t> masks, unsigned threads) {
  check_sizes(boxes.size(), max_leaf, max_stack);
  std::vector<BoxAccess::Primitive> primitives;
  primitives.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    primitives.push_back({to_bounds(boxes[i]), i, masks.empty() ? 0xFFu : masks[i]});
  Bvh bvh;
  const hierarchy::Root root =
      Build<BoxAccess>(std::span(primitives), max_leaf, threads, bvh.nodes).build(0, max_stack);
  bvh.root = root.node;
  bvh.stack_need = root.stack_need;
  bvh.order.reserve(primitives.size());
  for (const BoxAccess::Primitive& p : primitives) bvh.order.push_back(p.index);
  return bvh;
}

BvhRoot append_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                   std::size_t first, std::uint32_t max_leaf, std::uint32_t max_stack,
                   unsigned threads, std::span<std::uint32_t> order,
                   const hierarchy::BoxFrame& frame, std::size_t more_before) {
  const std::size_t count = order.size();
  check_sizes(first + more_before + count, BVH_MAX_LEAF, UINT32_MAX);
  check_sizes(count, max_leaf, max_stack);
  // If every piece were a pair, a leaf would hold half as many pieces.
  const bool pairs = max_leaf >= 4 && needed_stack(count, max_leaf / 2) <= max_stack;
  const auto from = static_cast<std::uint32_t>(first),
             position = static_cast<std::uint32_t>(first + more_before);
  Bounds box;
  LargeVector<TrianglePiece> pieces =
      make_pieces(triangles, first, count, pairs, frame, threads, box);
  triangles.release_pages();  // from here on, only the pieces are needed
  const hierarchy::Root root =
      pairs ? Build<PieceAccess<2>>(pieces, max_leaf, threads, nodes).build(position, max_stack)
            : Build<PieceAccess<1>>(pieces, max_leaf, threads, nodes).build(position, max_stack);
  auto at = order.begin();
  for (const TrianglePiece& piece : pieces)
    for (std::uint32_t i = 0; i < piece.count(); ++i) *at++ = from + piece.first() + i;
  return {root.node, root.stack_need, to_box(box)};
}

BvhRoot append_cut_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                       std::size_t first, std::size_t count, std::uint32_t max_leaf,
                       std::uint32_t max_stack, unsigned threads, LargeVector<std::uint32_t>& order,
                       const hierarchy::BoxFrame& frame) {
  const std::size_t room = hierarchy::find_room(count);
  check_sizes(order.size() + count + room, BVH_MAX_LEAF, UINT32_MAX);
  check_sizes(count + room, max_leaf / 2, max_stack);
  if (count == 0) return {};
  Bounds bounds;
  hierarchy::CutPieces pieces;
  pieces.margin_m = frame.margin_m;
  pieces.pieces = make_pieces(triangles, first, count, true, frame, threads, bounds, &pieces.large);
  triangles.release_pages();  // from here on, only the pieces are needed
  hierarchy::LeafParts parts;
  const hierarchy::Root root = hierarchy::build_cutting<QuantisedNodes>(
      std::move(pieces), static_cast<std::uint32_t>(count), max_leaf, max_stack, threads,
      static_cast<std::uint32_t>(order.size()), nodes, parts);
  std::vector<std::uint32_t> cut;  // which triangle each cut is of
  const auto triangle_of = [&](std::uint32_t part) {
    return part < count ? part : cut[(part - count) / 2];
  };
  cut.reserve(parts.cuts.size());
  for (const hierarchy::Cut& one : parts.cuts) cut.push_back(triangle_of(one.part));
  for (const std::uint32_t part : parts.order)
    order.push_back(static_cast<std::uint32_t>(first) + triangle_of(part));
  return {root.node, root.stack_need, to_box(bounds)};
}

}  // namespace nightcity::scene
