// Builds a bounding volume hierarchy on many threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "formats/free_memory.h"
#include "formats/hierarchy/builder.h"
#include "formats/large_vector.h"
#include "formats/parallel.h"

namespace nightcity::hierarchy {

// Ranges of at most this many primitives are one task of one thread.
constexpr std::uint32_t max_task = 1u << 15;

struct Root {
  std::uint32_t node = no_child;  // a node, a leaf, or no_child
  std::uint32_t stack_need = 0;   // entries that a ray may have to defer
  Bounds box;                     // of all primitives
};

/// Builds a hierarchy whose top is split range by range, each by one of the threads, until the
/// ranges are tasks. Neither depends on the number of threads. Access and Nodes are as Builder's.
template <class Access, class Nodes>
class ParallelBuild {
 public:
  using Primitive = typename Access::Primitive;
  using Node = typename Nodes::Node;
  /// Appends to `nodes`. The last `room` of the primitives are none yet, but room for what `cuts`
  /// cuts.
  ParallelBuild(std::span<Primitive> primitives, std::uint32_t max_leaf, unsigned threads,
                LargeVector<Node>& nodes, const typename Access::Cuts& cuts = {},
                std::uint32_t room = 0)
      : builder_(primitives, max_leaf, cuts),
        count_(static_cast<std::uint32_t>(primitives.size()) - room),
        room_(room),
        threads_(threads),
        nodes_(nodes) {}

  /// Positions in leaves count from `first` on. A ray may defer `stack` entries.
  Root build(std::uint32_t first, std::uint32_t stack) {
    Root result;
    const std::uint32_t count = count_;
    if (count == 0) return result;
    const Range all = measure(first);
    result.box = all.box;
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
  using RangeBuilder = Builder<Access, Nodes>;
  using Range = typename RangeBuilder::Range;
  struct Task {
    Range range;
    std::uint32_t stack, node, child;  // child `child` of top node `node`
    std::uint32_t need = 0;
    LargeVector<Node> nodes{};
    std::uint32_t root = no_child;
    bool done = false;
  };
  struct Top {
    Range range;
    std::uint32_t stack;
    typename RangeBuilder::Children children{};
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
    all.room = room_;
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
    nodes_.push_back(RangeBuilder::make_node(tops_[index].range, tops_[index].children));
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
      return child == no_child || is_leaf(child) ? child : child + base;
    };
    for (Node node : task.nodes) {
      for (std::uint32_t& child : node.child) child = moved(child);
      nodes_.push_back(node);
    }
    free_memory(task.nodes);
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

  RangeBuilder builder_;
  std::uint32_t count_, room_;
  unsigned threads_;
  LargeVector<Node>& nodes_;
  std::uint32_t base_ = 0;
  std::vector<Top> tops_;
  std::vector<Task> tasks_;
};

}  // namespace nightcity::hierarchy
