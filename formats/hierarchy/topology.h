// The order and topology of a hierarchy as numbers in a file (SPEC.md, 2.6), and back. A file may
// be hostile: what decode() returns can be measured and traversed whatever the file holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/hierarchy/child.h"
#include "formats/hierarchy/cuts.h"
#include "formats/hierarchy/parallel_build.h"
#include "formats/large_vector.h"

namespace nightcity::hierarchy {

/// A node without boxes.
struct BareNode {
  std::uint32_t child[4];
  float area;  // half the surfaces of its children's boxes, summed
};

/// Builder makes this in order to store a hierarchy.
struct BareNodes {
  using Node = BareNode;
  static Node make(const Bounds&, std::span<const MeasuredChild> children) {
    Node node{{no_child, no_child, no_child, no_child}, 0};
    for (const MeasuredChild& child : children) node.area += child.box.half_area();
    return node;
  }
};

// A node's four children in 4 bits each, the first in the lowest: nothing, a leaf of so many
// triangles, or a node.
constexpr std::uint32_t most_in_leaf = 14, child_is_node = 15, child_bits = 4;

// An entry of the order stands for up to 32 triangles whose numbers follow each other: the first
// one's in the lower bits, and one less than their number.
constexpr int run_shift = 27;
constexpr std::uint32_t most_in_run = 32;

struct Encoded {
  std::vector<std::uint16_t> topology;
  std::vector<std::uint32_t> order;
  std::vector<Cut> cuts;
};

/// Returns a hierarchy as numbers, without cuts. `order`: the triangle or part at each position of
/// the leaves. Nodes and triangles are written as a traversal meets them that takes the children of
/// each node in their order.
Encoded encode(std::span<const BareNode> nodes, std::uint32_t root,
               std::span<const std::uint32_t> order);

/// A hierarchy's nodes as a traversal meets them: the children of a node that are nodes are the
/// next one, the one after all below that, and so on.
struct Topology {
  std::vector<std::uint16_t> codes;      // of each node's children, as in the file
  std::vector<std::uint32_t> nodes;      // of each node: the nodes below it and itself
  std::vector<std::uint32_t> triangles;  // of each node: those below it
  std::uint32_t stack_need = 0;          // entries that a ray may have to defer

  std::uint32_t code(std::size_t node, std::uint32_t child) const {
    return (codes[node] >> (child_bits * child)) & ((1u << child_bits) - 1);
  }
};

/// Reads the topology of a hierarchy over `triangles` triangles or parts, of which at most
/// `max_leaf` are in a leaf. Without a node there is one leaf. Returns why it is refused, "" where it is not: a node
/// too many or too few, one with fewer than two children, leaves that are too large or do not add
/// up, or a ray that would have to defer more than `max_stack` entries.
std::string decode_topology(std::span<const std::byte> bytes, std::uint32_t triangles,
                            std::uint32_t max_leaf, std::uint32_t max_stack, Topology& result);

/// Reads the triangle or part at each position of the leaves: `order` has room for all, which are
/// one more than there are triangles for each cut, and `first` is added to their numbers. Returns
/// why it is refused, "" where it is not: it does not have each part once that was not cut.
std::string decode_order(std::span<const std::byte> bytes, std::uint32_t first,
                         std::span<std::uint32_t> order, std::span<const Cut> cuts = {});

}  // namespace nightcity::hierarchy
