#include "formats/hierarchy/topology.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace nightcity::hierarchy {
namespace {

static_assert(std::endian::native == std::endian::little);
static_assert((1u << run_shift) == leaf_first_mask + 1);

class Encoder {
 public:
  Encoder(std::span<const BareNode> nodes, std::span<const std::uint32_t> order)
      : nodes_(nodes), order_(order) {}

  Encoded encode(std::uint32_t root) {
    if (root != no_child) add(root);
    return std::move(result_);
  }

 private:
  // The builder's stack bounds the depth of this recursion.
  void add(std::uint32_t child) {
    if (is_leaf(child)) return add_leaf(child);
    const BareNode& node = nodes_[child];
    std::uint32_t code = 0;
    for (std::uint32_t i = 0; i < 4 && node.child[i] != no_child; ++i)
      code |= (is_leaf(node.child[i]) ? size_of_leaf(node.child[i]) : child_is_node)
              << (child_bits * i);
    result_.topology.push_back(static_cast<std::uint16_t>(code));
    for (std::uint32_t i = 0; i < 4 && node.child[i] != no_child; ++i) add(node.child[i]);
  }

  void add_leaf(std::uint32_t leaf) {
    for (std::uint32_t i = 0; i < size_of_leaf(leaf); ++i) {
      const std::uint32_t triangle = order_[first_of_leaf(leaf) + i];
      if (run_ > 0 && run_ < most_in_run && triangle == run_first_ + run_) {
        result_.order.back() += 1u << run_shift;
        ++run_;
        continue;
      }
      result_.order.push_back(triangle);
      run_first_ = triangle;
      run_ = 1;
    }
  }

  std::span<const BareNode> nodes_;
  std::span<const std::uint32_t> order_;
  Encoded result_;
  std::uint32_t run_first_ = 0, run_ = 0;
};

template <class T>
T load(std::span<const std::byte> bytes, std::size_t index) {
  T value;
  std::memcpy(&value, bytes.data() + index * sizeof value, sizeof value);
  return value;
}

// Returns how many children a node has, 0 where some are missing in between or there are too few.
std::uint32_t count_children(const Topology& t, std::size_t node) {
  std::uint32_t count = 0;
  while (count < 4 && t.code(node, count) != 0) ++count;
  for (std::uint32_t i = count; i < 4; ++i)
    if (t.code(node, i) != 0) return 0;
  return count < 2 ? 0 : count;
}

}  // namespace

Encoded encode(std::span<const BareNode> nodes, std::uint32_t root,
               std::span<const std::uint32_t> order) {
  return Encoder(nodes, order).encode(root);
}

std::string decode_topology(std::span<const std::byte> bytes, std::uint32_t triangles,
                            std::uint32_t max_leaf, std::uint32_t max_stack, Topology& result) {
  result = {};
  if (bytes.size() % sizeof(std::uint16_t) != 0) return "its nodes end within one";
  const std::size_t count = bytes.size() / sizeof(std::uint16_t);
  if (count == 0)
    return triangles >= 1 && triangles <= max_leaf ? "" : "it has no node for its triangles";
  // Each node adds a leaf or more to those below, so there are fewer nodes than triangles.
  if (count >= triangles) return "it has more nodes than triangles can need";
  result.codes.resize(count);
  std::memcpy(result.codes.data(), bytes.data(), bytes.size());
  result.nodes.resize(count);
  result.triangles.resize(count);
  // From the last node to the first: the nodes that a node's children begin at are then known. They
  // are those whose parent has not come yet, the first of them last.
  std::vector<std::uint32_t> open, needs;
  for (std::size_t n = count; n-- > 0;) {
    const std::uint32_t children = count_children(result, n);
    if (children == 0) return "a node has fewer than two children, or gaps between them";
    std::uint32_t nodes = 1, deepest = 0;
    std::uint64_t below = 0;
    for (std::uint32_t i = 0; i < children; ++i) {
      const std::uint32_t code = result.code(n, i);
      if (code == child_is_node) {
        if (open.empty()) return "a node is missing";
        nodes += result.nodes[open.back()];
        below += result.triangles[open.back()];
        deepest = std::max(deepest, needs.back());
        open.pop_back();
        needs.pop_back();
      } else {
        if (code > max_leaf) return "a leaf has more triangles than it may";
        below += code;
      }
    }
    if (below > triangles) return "its leaves have more triangles than there are";
    result.nodes[n] = nodes;
    result.triangles[n] = static_cast<std::uint32_t>(below);
    open.push_back(static_cast<std::uint32_t>(n));
    needs.push_back(children - 1 + deepest);
  }
  if (open.size() != 1) return "a node is below no other";
  if (result.triangles[0] != triangles) return "its leaves have fewer triangles than there are";
  if (needs[0] > max_stack) return "it is too deep";
  result.stack_need = needs[0];
  return "";
}

std::string decode_order(std::span<const std::byte> bytes, std::uint32_t first,
                         std::span<std::uint32_t> order, std::span<const Cut> cuts) {
  if (bytes.size() % sizeof(std::uint32_t) != 0) return "its order ends within a number";
  const std::size_t parts = order.size() + cuts.size();  // a cut makes two of one
  std::vector<std::uint64_t> seen((parts + 63) / 64);
  for (const Cut& cut : cuts) seen[cut.part / 64] |= std::uint64_t{1} << (cut.part % 64);
  std::size_t done = 0;
  for (std::size_t i = 0; i < bytes.size() / sizeof(std::uint32_t); ++i) {
    const auto entry = load<std::uint32_t>(bytes, i);
    const std::uint32_t count = (entry >> run_shift) + 1;
    if (count > order.size() - done) return "its order has more triangles than there are";
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t triangle = (entry & leaf_first_mask) + k;
      if (triangle >= parts) return "its order names a triangle that is not there";
      const std::uint64_t bit = std::uint64_t{1} << (triangle % 64);
      if (seen[triangle / 64] & bit) return "its order names a triangle twice";
      seen[triangle / 64] |= bit;
      order[done++] = first + triangle;
    }
  }
  return done == order.size() ? "" : "its order has fewer triangles than there are";
}

}  // namespace nightcity::hierarchy
