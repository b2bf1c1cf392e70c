// Puts more leaves into a hierarchy that is built.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "formats/hierarchy/bounds.h"
#include "formats/large_vector.h"
#include "shaders/bvh_types.h"

namespace nightcity::scene {

/// Puts leaves where the boxes that rays visit grow least by them: into a node that has fewer than
/// four children, or beside a child, with which a leaf gets a node of its own. (Branch and bound as
/// in J. Bittner, M. Hapala, V. Havran, Fast insertion-based optimization of bounding volume
/// hierarchies, CGF 32, 2013.)
class LeafInserter {
 public:
  /// `root` is a node of `nodes`, and stays one. A ray may have to defer up to `most_deferred`
  /// entries more than before.
  LeafInserter(LargeVector<gpu::BvhNode>& nodes, std::uint32_t root, std::uint32_t most_deferred)
      : nodes_(nodes), root_(root), most_deferred_(most_deferred) {}

  /// Puts a leaf (gpu::BvhNode::child) with this box, which is in the frame of the nodes. Returns
  /// false, and does nothing, where rays would have to defer too much wherever it was looked for.
  bool insert(std::uint32_t leaf, const hierarchy::Bounds& box);

  /// Returns how many more entries than before a ray may have to defer.
  std::uint32_t deferred() const { return find_deferred(root_); }
  /// Writes what has changed to the nodes, of which there are more then. To be called once; without
  /// it, they are as they were.
  void finish();

 private:
  struct Child {
    std::uint32_t number;
    hierarchy::Bounds box;
  };
  // A node with boxes as numbers.
  struct OpenNode {
    std::array<Child, 4> children{};
    std::size_t count = 0;
    // How many more entries than before a ray may have to defer because of this node, and because of
    // those below it.
    std::uint32_t deferred = 0, below = 0;
  };
  // A node that a search has come to.
  struct Visit {
    std::uint32_t node;
    std::size_t from;  // index of the visit before
    float cost_m2;     // by which half the surfaces of boxes would grow on the way
    std::uint32_t deferred;
  };
  struct Place {
    float cost_m2;      // of that growth, and of a node more
    std::size_t visit;  // none where there is no place
    int child;          // beside which the leaf would lie, or -1: in the node itself
  };
  static constexpr std::size_t none = ~std::size_t{0};

  static OpenNode open(const gpu::BvhNode& node);
  OpenNode look(std::uint32_t number) const;
  OpenNode& change(std::uint32_t number);
  std::uint32_t find_deferred(std::uint32_t number) const;
  Place find_place(const hierarchy::Bounds& box);
  void add_pair(OpenNode& node, std::size_t child, const Child& added);

  LargeVector<gpu::BvhNode>& nodes_;
  std::uint32_t root_, most_deferred_;
  std::unordered_map<std::uint32_t, OpenNode> changed_;
  std::uint32_t added_ = 0;  // nodes
  std::vector<Visit> visits_;
};

}  // namespace nightcity::scene
