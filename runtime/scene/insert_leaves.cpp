#include "runtime/scene/insert_leaves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <span>

#include "runtime/scene/bvh_node.h"

namespace nightcity::scene {
namespace {

using hierarchy::Bounds;

// A search looks at so many nodes at most: usually some tens. Where a thousand boxes lie in the same
// place, it would look at all of them.
constexpr std::size_t most_visits = 512;

float find_joint_area(Bounds a, const Bounds& b) {
  a.grow(b);
  return a.half_area();
}

bool is_leaf(std::uint32_t child) {
  return (child & BVH_LEAF) != 0;
}

}  // namespace

LeafInserter::OpenNode LeafInserter::open(const gpu::BvhNode& node) {
  OpenNode result;
  std::array<float, 3> step_m;
  for (int axis = 0; axis < 3; ++axis)
    step_m[static_cast<std::size_t>(axis)] =
        std::ldexp(1.0f, static_cast<int>(node.exponents >> (8 * axis) & 255u) - 127);
  for (int i = 0; i < 4; ++i) {
    if (node.child[i] == BVH_EMPTY) continue;
    Child& child = result.children[result.count++];
    child.number = node.child[i];
    for (int axis = 0; axis < 3; ++axis) {
      const auto find_plane = [&](std::uint32_t planes) {
        return node.origin[axis] + static_cast<float>(planes >> (8 * i) & 255u) *
                                       step_m[static_cast<std::size_t>(axis)];
      };
      child.box.lower[axis] = find_plane(node.lower[axis]);
      child.box.upper[axis] = find_plane(node.upper[axis]);
    }
  }
  return result;
}

LeafInserter::OpenNode LeafInserter::look(std::uint32_t number) const {
  const auto found = changed_.find(number);
  return found != changed_.end() ? found->second : open(nodes_[number]);
}

LeafInserter::OpenNode& LeafInserter::change(std::uint32_t number) {
  const auto found = changed_.find(number);
  return found != changed_.end() ? found->second
                                 : changed_.emplace(number, open(nodes_[number])).first->second;
}

std::uint32_t LeafInserter::find_deferred(std::uint32_t number) const {
  if (is_leaf(number)) return 0;
  const auto found = changed_.find(number);
  return found != changed_.end() ? found->second.deferred + found->second.below : 0;
}

LeafInserter::Place LeafInserter::find_place(const Bounds& box) {
  visits_.assign(1, {root_, none, 0, 0});
  const auto comes_later = [this](std::size_t a, std::size_t b) {
    return visits_[a].cost_m2 != visits_[b].cost_m2 ? visits_[a].cost_m2 > visits_[b].cost_m2
                                                    : a > b;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(comes_later)> waiting(
      comes_later);
  waiting.push(0);
  Place best{std::numeric_limits<float>::max(), none, -1};
  for (std::size_t visited = 0;
       visited < most_visits && !waiting.empty() && visits_[waiting.top()].cost_m2 < best.cost_m2;
       ++visited) {
    const std::size_t at = waiting.top();
    waiting.pop();
    const Visit visit = visits_[at];
    const OpenNode node = look(visit.node);
    // The node and all below it would need one entry more.
    const bool may_take = visit.deferred + node.deferred + node.below < most_deferred_;
    if (may_take && node.count < node.children.size()) best = {visit.cost_m2, at, -1};
    for (std::size_t i = 0; i < node.count; ++i) {
      const Child& child = node.children[i];
      const float joint_m2 = find_joint_area(child.box, box);
      if (may_take && visit.cost_m2 + joint_m2 < best.cost_m2)
        best = {visit.cost_m2 + joint_m2, at, static_cast<int>(i)};
      const float cost_m2 = visit.cost_m2 + joint_m2 - child.box.half_area();
      if (is_leaf(child.number) || cost_m2 >= best.cost_m2) continue;
      visits_.push_back({child.number, at, cost_m2, visit.deferred + node.deferred});
      waiting.push(visits_.size() - 1);
    }
  }
  return best;
}

void LeafInserter::add_pair(OpenNode& node, std::size_t child, const Child& added) {
  const auto number = static_cast<std::uint32_t>(nodes_.size()) + added_++;
  OpenNode pair;
  pair.children = {node.children[child], added};
  pair.count = 2;
  pair.deferred = 1;
  pair.below = find_deferred(node.children[child].number);
  node.children[child].number = number;
  node.children[child].box.grow(added.box);
  node.below = std::max(node.below, pair.deferred + pair.below);
  changed_.emplace(number, pair);
}

bool LeafInserter::insert(std::uint32_t leaf, const Bounds& box) {
  const Child added{leaf, box};
  const Place place = find_place(box);
  if (place.visit == none) return false;
  std::size_t at = place.visit;
  OpenNode& node = change(visits_[at].node);
  if (place.child >= 0) {
    add_pair(node, static_cast<std::size_t>(place.child), added);
  } else {
    node.children[node.count++] = added;
    ++node.deferred;
  }
  for (std::uint32_t below = visits_[at].node; (at = visits_[at].from) != none;) {
    OpenNode& above = change(visits_[at].node);
    for (std::size_t i = 0; i < above.count; ++i)
      if (above.children[i].number == below) above.children[i].box.grow(box);
    above.below = std::max(above.below, find_deferred(below));
    below = visits_[at].node;
  }
  return true;
}

void LeafInserter::finish() {
  nodes_.resize(nodes_.size() + added_);
  for (auto& [number, node] : changed_) {
    // The largest first, as shadow rays visit them.
    std::stable_sort(
        node.children.begin(), node.children.begin() + static_cast<std::ptrdiff_t>(node.count),
        [](const Child& a, const Child& b) { return a.box.half_area() > b.box.half_area(); });
    std::array<hierarchy::MeasuredChild, 4> measured;
    Bounds all;
    for (std::size_t i = 0; i < node.count; ++i) {
      measured[i] = {node.children[i].box, 0xFFu};
      all.grow(node.children[i].box);
    }
    gpu::BvhNode made =
        quantise_node(all, std::span<const hierarchy::MeasuredChild>(measured.data(), node.count));
    for (std::size_t i = 0; i < node.count; ++i) made.child[i] = node.children[i].number;
    nodes_[number] = made;
  }
}

}  // namespace nightcity::scene
