#include "runtime/scene/bvh.h"

#include <algorithm>
#include <mutex>

#include "formats/error.h"
#include "formats/parallel.h"
#include "runtime/scene/bvh_builder.h"
#include "runtime/scene/triangle_pieces.h"

namespace nightcity::scene {
namespace {

// Ranges of at most this many primitives are one task of one thread.
constexpr std::uint32_t max_task = 1u << 15;

// Primitives that are only boxes: instances.
struct BoxAccess {
  struct Primitive {
    Bounds box;
    std::uint32_t index, mask;
  };
  static constexpr bool has_masks = true;
  static constexpr std::uint32_t max_weight = 1;
  static std::uint32_t weight_of(const Primitive&) { return 1; }
  static Bounds bounds_of(const Primitive& p) { return p.box; }
  static std::uint32_t mask_of(const Primitive& p) { return p.mask; }
  static bool precedes(const Primitive& a, const Primitive& b) { return a.index < b.index; }
};

template <std::uint32_t max>
struct PieceAccess {
  using Primitive = TrianglePiece;
  static constexpr bool has_masks = false;
  static constexpr std::uint32_t max_weight = max;
  static Bounds bounds_of(const Primitive& p) { return p.bounds(); }
  static std::uint32_t weight_of(const Primitive& p) { return max == 1 ? 1 : p.count(); }
  static std::uint32_t mask_of(const Primitive&) { return 0xFFu; }
  static bool precedes(const Primitive& a, const Primitive& b) { return a.first() < b.first(); }
};

// Builds a BVH whose top is split range by range, each by one of the threads, until the ranges are
// tasks. Neither depends on the number of threads.
template <class Access>
class ParallelBuild {
 public:
  using Primitive = typename Access::Primitive;
  ParallelBuild(std::span<Primitive> primitives, std::uint32_t max_leaf, unsigned threads,
                LargeVector<gpu::BvhNode>& nodes)
      : builder_(primitives, max_leaf),
        count_(static_cast<std::uint32_t>(primitives.size())),
        threads_(threads),
        nodes_(nodes) {}

  // Positions in leaves count from `first` on.
  BvhRoot build(std::uint32_t first, std::uint32_t stack) {
    BvhRoot result;
    const std::uint32_t count = count_;
    if (count == 0) return result;
    const Range all = measure(first);
    result.box = all.box.to_box();
    if (count <= max_task) {
      result.node = builder_.build(all, stack, nodes_, result.stack_need);
      return result;
    }
    // Memory is taken when it is written to, so room for more than the usual 0.4 nodes a triangle
    // costs nothing, and no copy is made as the nodes become more.
    if (nodes_.capacity() - nodes_.size() < all.weight / 2)
      nodes_.reserve(std::max(2 * nodes_.capacity(), nodes_.size() + all.weight / 2));
    split_top(all, stack);
    build_tasks();
    result.node = base_;
    result.stack_need = find_need(0);
    return result;
  }

 private:
  using Builder = BvhBuilder<Access>;
  using Range = typename Builder::Range;
  struct Task {
    Range range;
    std::uint32_t stack, node, child;  // child `child` of top node `node`
    std::uint32_t need = 0;
    LargeVector<gpu::BvhNode> nodes{};
    std::uint32_t root = BVH_EMPTY;
    bool done = false;
  };
  struct Top {
    Range range;
    std::uint32_t stack;
    typename Builder::Children children{};
    std::array<std::uint32_t, 4> need{}, top{};  // of each child; top node 0: it is none
  };

  Range measure(std::uint32_t first) const {
    const std::uint32_t pieces = (count_ + max_task - 1) / max_task;
    std::vector<Range> measured(pieces);
    run_parallel(pieces, threads_, [&](std::size_t i) {
      const std::uint32_t begin = static_cast<std::uint32_t>(i) * max_task;
      measured[i] = builder_.measure(begin, std::min(count_, begin + max_task), 0);
    });
    Range all;
    all.end = count_;
    all.first = first;
    for (const Range& r : measured) {
      all.box.grow(r.box);
      all.centres.grow(r.centres);
      all.weight += r.weight;
      all.mask |= r.mask;
      all.casting += r.casting;
    }
    return all;
  }

  void split_top(const Range& all, std::uint32_t stack) {
    base_ = static_cast<std::uint32_t>(nodes_.size());
    tops_.push_back({all, stack});
    for (std::size_t begin = 0; begin < tops_.size();) {
      const std::size_t end = tops_.size();
      run_parallel(end - begin, threads_, [&](std::size_t i) {
        Top& top = tops_[begin + i];
        top.children = builder_.split_in_four(top.range, top.stack);
      });
      for (; begin < end; ++begin) add_children(static_cast<std::uint32_t>(begin));
    }
  }

  void add_children(std::uint32_t index) {
    nodes_.push_back(Builder::make_node(tops_[index].range, tops_[index].children));
    const std::uint32_t count = tops_[index].children.count,
                        stack = tops_[index].stack - (count - 1);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Range range = tops_[index].children.range[i];
      if (range.size() <= max_task) {
        tasks_.push_back({range, stack, index, i});
      } else {
        tops_[index].top[i] = static_cast<std::uint32_t>(tops_.size());
        nodes_[base_ + index].child[i] = base_ + tops_[index].top[i];
        tops_.push_back({range, stack});
      }
    }
  }

  void build_tasks() {
    std::mutex appending;
    std::size_t next = 0;
    run_parallel(tasks_.size(), threads_, [&](std::size_t i) {
      Task& task = tasks_[i];
      task.root = builder_.build(task.range, task.stack, task.nodes, task.need);
      const std::lock_guard lock(appending);
      task.done = true;
      for (; next < tasks_.size() && tasks_[next].done; ++next) append(tasks_[next]);
    });
  }

  void append(Task& task) {
    const auto base = static_cast<std::uint32_t>(nodes_.size());
    const auto moved = [base](std::uint32_t child) {
      return child == BVH_EMPTY || (child & BVH_LEAF) ? child : child + base;
    };
    for (gpu::BvhNode node : task.nodes) {
      for (std::uint32_t& child : node.child) child = moved(child);
      nodes_.push_back(node);
    }
    task.nodes = {};
    nodes_[base_ + task.node].child[task.child] = moved(task.root);
    tops_[task.node].need[task.child] = task.need;
  }

  std::uint32_t find_need(std::uint32_t index) const {
    const Top& top = tops_[index];
    std::uint32_t deepest = 0;
    for (std::uint32_t i = 0; i < top.children.count; ++i)
      deepest = std::max(deepest, top.top[i] != 0 ? find_need(top.top[i]) : top.need[i]);
    return top.children.count - 1 + deepest;
  }

  Builder builder_;
  std::uint32_t count_;
  unsigned threads_;
  LargeVector<gpu::BvhNode>& nodes_;
  std::uint32_t base_ = 0;
  std::vector<Top> tops_;
  std::vector<Task> tasks_;
};

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
  std::uint32_t need = 0;
  for (; boxes > max_leaf; boxes = (boxes + 3) / 4) need += 3;
  return need;
}

Bvh build_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t max_stack,
              std::span<const std::uint8_t> masks, unsigned threads) {
  check_sizes(boxes.size(), max_leaf, max_stack);
  std::vector<BoxAccess::Primitive> primitives;
  primitives.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    primitives.push_back({to_bounds(boxes[i]), i, masks.empty() ? 0xFFu : masks[i]});
  Bvh bvh;
  const BvhRoot root = ParallelBuild<BoxAccess>(std::span(primitives), max_leaf, threads, bvh.nodes)
                           .build(0, max_stack);
  bvh.root = root.node;
  bvh.stack_need = root.stack_need;
  bvh.order.reserve(primitives.size());
  for (const BoxAccess::Primitive& p : primitives) bvh.order.push_back(p.index);
  return bvh;
}

BvhRoot append_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                   std::size_t first, std::uint32_t max_leaf, std::uint32_t max_stack,
                   unsigned threads, std::span<std::uint32_t> order) {
  const std::size_t count = order.size();
  check_sizes(first + count, BVH_MAX_LEAF, UINT32_MAX);
  check_sizes(count, max_leaf, max_stack);
  // If every piece were a pair, a leaf would hold half as many pieces.
  const bool pairs = max_leaf >= 4 && needed_stack(count, max_leaf / 2) <= max_stack;
  const auto from = static_cast<std::uint32_t>(first);
  LargeVector<TrianglePiece> pieces = make_pieces(triangles, first, count, pairs, threads);
  triangles.release_pages();  // from here on, only the pieces are needed
  const BvhRoot root =
      pairs
          ? ParallelBuild<PieceAccess<2>>(pieces, max_leaf, threads, nodes).build(from, max_stack)
          : ParallelBuild<PieceAccess<1>>(pieces, max_leaf, threads, nodes).build(from, max_stack);
  auto at = order.begin();
  for (const TrianglePiece& piece : pieces)
    for (std::uint32_t i = 0; i < piece.count(); ++i) *at++ = from + piece.first() + i;
  return root;
}

void rebase(Bvh& bvh, std::uint32_t node_base, std::uint32_t first_base) {
  const auto shift = [&](std::uint32_t& child) {
    if (child != BVH_EMPTY) child += (child & BVH_LEAF) ? first_base : node_base;
  };
  shift(bvh.root);
  for (gpu::BvhNode& node : bvh.nodes)
    for (std::uint32_t& child : node.child) shift(child);
}

}  // namespace nightcity::scene
