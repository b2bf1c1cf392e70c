#include "runtime/scene/stored_bvh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "formats/hierarchy/topology.h"
#include "formats/parallel.h"
#include "runtime/scene/quantised_nodes.h"
#include "runtime/scene/triangle_parts.h"

namespace nightcity::scene {
namespace {

using hierarchy::Bounds;
using hierarchy::Topology;

// Nodes with at most so many triangles below them are one task of one thread.
constexpr std::uint32_t max_task = 1u << 13;
// Pages of the file that triangles are read from are given back after so many triangles.
constexpr std::size_t resident_triangles = 1 << 18;
// A hierarchy of these triangles has the area that its file says but for rounding. A larger one
// belongs to others, and rays would be slow.
constexpr double max_area = 1.01;

// Measures the boxes of a hierarchy from the leaves to the root.
class Measuring {
 public:
  Measuring(const Topology& topology, const TriangleList& triangles, const TriangleParts& parts,
            const hierarchy::BoxFrame& frame, std::size_t position, std::span<std::uint32_t> order,
            LargeVector<gpu::BvhNode>& nodes)
      : topology_(topology),
        triangles_(triangles),
        parts_(parts),
        frame_(frame),
        position_(static_cast<std::uint32_t>(position)),
        order_(order),
        base_(static_cast<std::uint32_t>(nodes.size())) {
    nodes.resize(nodes.size() + topology.codes.size());
    nodes_ = nodes.data() + base_;
  }

  // Returns the box of all triangles, in their own frame.
  Bounds measure(unsigned threads) {
    if (topology_.codes.empty()) {
      measure_leaf(0, static_cast<std::uint32_t>(order_.size()));
      return all_;
    }
    find_tasks(0, 0);
    std::atomic<std::size_t> read = 0;
    run_parallel(tasks_.size(), threads, [&](std::size_t i) {
      measure(tasks_[i]);
      const std::size_t count = topology_.triangles[tasks_[i].node], before = read.fetch_add(count);
      if (before / resident_triangles != (before + count) / resident_triangles)
        triangles_.release_pages();
    });
    if (hides_some_) return all_;
    Pass top{area_m2_, {}, 0};
    measure_top(0, 0, top);
    for (const Task& task : tasks_) {
      area_m2_ += task.area_m2;
      all_.grow(task.all);
    }
    return all_;
  }
  double area_m2() const { return area_m2_; }
  /// Returns whether some triangle is not shown, so that nodes are not made.
  bool hides_some() const { return hides_some_; }

 private:
  struct Task {
    std::uint32_t node, position;  // of its first triangle, from 0 on
    Bounds box{}, all{};           // in the frame of the boxes, and in that of the triangles
    double area_m2 = 0;
  };
  // A thread knows this while it measures.
  struct Pass {
    double& area_m2;
    std::vector<Bounds> boxes;  // of the task's triangles
    std::uint32_t position;     // of the first of these
  };

  void find_tasks(std::uint32_t node, std::uint32_t position) {
    if (topology_.triangles[node] <= max_task) {
      tasks_.push_back({node, position});
      return;
    }
    for_each_child(node, position,
                   [&](auto, std::uint32_t code, std::uint32_t at, std::uint32_t child) {
                     if (code == hierarchy::child_is_node) find_tasks(child, at);
                   });
  }

  // Calls use(i, code, position, node) for each child of a node.
  template <class Use>
  void for_each_child(std::uint32_t node, std::uint32_t position, Use use) const {
    std::uint32_t next = node + 1;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t code = topology_.code(node, i);
      if (code == 0) return;
      use(i, code, position, next);
      if (code == hierarchy::child_is_node) {
        position += topology_.triangles[next];
        next += topology_.nodes[next];
      } else {
        position += code;
      }
    }
  }

  // Makes a node, and returns its box. `below` returns that of a child that is a node, `leaf` that
  // of a leaf.
  template <class Below, class Leaf>
  Bounds make_node(std::uint32_t node, std::uint32_t position, double& area_m2, Below below,
                   Leaf leaf) {
    std::array<hierarchy::MeasuredChild, 4> children;
    std::array<std::uint32_t, 4> numbers;
    std::size_t count = 0;
    Bounds all;
    for_each_child(
        node, position, [&](auto, std::uint32_t code, std::uint32_t at, std::uint32_t child) {
          const bool is_node = code == hierarchy::child_is_node;
          children[count] = {is_node ? below(child, at) : leaf(at, code), 0xFFu};
          numbers[count] = is_node ? base_ + child : hierarchy::make_leaf(position_ + at, code);
          all.grow(children[count].box);
          ++count;
        });
    float area = 0;
    for (std::size_t i = 0; i < count; ++i) {
      area += children[i].box.half_area();
      children[i].box = children[i].box.widened(frame_.margin_m);
    }
    area_m2 += double(area);
    gpu::BvhNode made =
        QuantisedNodes::make(all.widened(frame_.margin_m),
                             std::span<const hierarchy::MeasuredChild>(children.data(), count));
    std::copy_n(numbers.begin(), count, made.child);
    nodes_[node] = made;
    return all;
  }

  void measure(Task& task) {
    Pass pass{task.area_m2, std::vector<Bounds>(topology_.triangles[task.node]), task.position};
    measure_boxes(task.position, pass.boxes, task.all);
    if (hides_some_) return;  // boxes may be infinite
    task.box = measure_below(task.node, task.position, pass);
  }

  // Measures the boxes of the triangles and parts from a position on. These become triangles in the
  // order.
  void measure_boxes(std::uint32_t position, std::span<Bounds> boxes, Bounds& all) {
    const std::span<std::uint32_t> numbers = order_.subspan(position, boxes.size());
    const TriangleParts::Found parts = parts_.replace(numbers);
    if (!triangles_.measure(numbers, frame_, boxes, all)) {
      hides_some_ = true;
      std::fill(boxes.begin(), boxes.end(), Bounds{});
    }
    for (const auto& [at, box] : parts) boxes[at] = box;
  }

  // The stack bounds the depth of these recursions, since a node has two children or more.
  Bounds measure_below(std::uint32_t node, std::uint32_t position, Pass& pass) {
    return make_node(
        node, position, pass.area_m2,
        [&](std::uint32_t child, std::uint32_t at) { return measure_below(child, at, pass); },
        [&](std::uint32_t at, std::uint32_t count) {
          Bounds box;
          for (std::uint32_t i = 0; i < count; ++i) box.grow(pass.boxes[at - pass.position + i]);
          return box;
        });
  }

  // Takes the boxes of tasks in the order in which find_tasks found them.
  Bounds measure_top(std::uint32_t node, std::uint32_t position, Pass& pass) {
    if (topology_.triangles[node] <= max_task) return tasks_[pass.position++].box;
    return make_node(
        node, position, pass.area_m2,
        [&](std::uint32_t child, std::uint32_t at) { return measure_top(child, at, pass); },
        [&](std::uint32_t at, std::uint32_t count) { return measure_leaf(at, count); });
  }

  Bounds measure_leaf(std::uint32_t position, std::uint32_t count) {
    std::vector<Bounds> boxes(count);
    measure_boxes(position, boxes, all_);
    Bounds box;
    for (const Bounds& b : boxes) box.grow(b);
    return box;
  }

  const Topology& topology_;
  const TriangleList& triangles_;
  const TriangleParts& parts_;
  const hierarchy::BoxFrame& frame_;
  std::uint32_t position_;  // of the first leaf's first triangle
  std::span<std::uint32_t> order_;
  std::uint32_t base_;
  gpu::BvhNode* nodes_;
  std::vector<Task> tasks_;
  Bounds all_;  // of the triangles, in their own frame
  double area_m2_ = 0;
  std::atomic<bool> hides_some_ = false;
};

}  // namespace

std::string append_stored_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                              std::size_t first, const StoredHierarchy& stored,
                              std::uint32_t max_leaf, std::uint32_t max_stack, unsigned threads,
                              std::span<std::uint32_t> order, BvhRoot& root,
                              const hierarchy::BoxFrame& frame, std::size_t more_before) {
  if (stored.along != frame.along) return "its boxes lie along another direction";
  if (stored.triangles + stored.count_cuts() != order.size())
    return "it is of another number of triangles";
  if (first + more_before + order.size() > BVH_LEAF_FIRST_MASK)
    return "the scene has no room for all of its parts";
  std::vector<hierarchy::Cut> cuts;
  if (const std::string fault = hierarchy::decode_cuts(stored.cuts, stored.triangles, cuts);
      !fault.empty())
    return fault;
  const auto positions = static_cast<std::uint32_t>(order.size());
  Topology topology;
  TriangleParts parts;
  std::array<std::string, 2> faults;
  run_parallel(2, threads, [&](std::size_t i) {
    faults[i] =
        i == 0
            ? hierarchy::decode_topology(stored.topology, positions, max_leaf, max_stack, topology)
            : hierarchy::decode_order(stored.order, static_cast<std::uint32_t>(first), order, cuts);
  });
  for (const std::string& fault : faults)
    if (!fault.empty()) return fault;
  if (const std::string fault =
          parts.measure(cuts, triangles, first, stored.triangles, frame, threads);
      !fault.empty())
    return fault;
  const std::size_t base = nodes.size();
  Measuring measuring(topology, triangles, parts, frame, first + more_before, order, nodes);
  const Box box = to_box(measuring.measure(threads));
  triangles.release_pages();
  std::string fault;
  if (measuring.hides_some())
    fault = "some of its triangles are not shown";
  else if (box.lower != stored.lower || box.upper != stored.upper)
    fault = "its triangles fill another box";
  else if (!(measuring.area_m2() <= max_area * stored.area_m2))
    fault = "its boxes are larger than they were";
  if (!fault.empty()) {
    nodes.resize(base);
    return fault;
  }
  root.node = topology.codes.empty()
                  ? hierarchy::make_leaf(static_cast<std::uint32_t>(first + more_before), positions)
                  : static_cast<std::uint32_t>(base);
  root.stack_need = topology.stack_need;
  root.box = box;
  return "";
}

}  // namespace nightcity::scene
