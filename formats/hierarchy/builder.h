// Splits primitives by the binned surface-area heuristic (SAH), in place: Wald, On fast
// construction of SAH-based bounding volume hierarchies, 2007.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "formats/hierarchy/binned_split.h"
#include "formats/hierarchy/bounds.h"
#include "formats/hierarchy/child.h"
#include "formats/hierarchy/small_split.h"
#include "formats/large_vector.h"

namespace nightcity::hierarchy {

/// Returns the deferred entries that a hierarchy of object medians over `boxes` boxes needs: the
/// smallest stack that a builder can keep to.
constexpr std::uint32_t find_needed_stack(std::size_t boxes, std::uint32_t max_leaf) {
  std::uint32_t need = 0;
  for (; boxes > max_leaf; boxes = (boxes + 3) / 4) need += 3;
  return need;
}

/// Builder cuts no primitive.
struct NoCuts {
  static constexpr bool may_cut = false;
};

/// A child of a node, as the builder has measured it.
struct MeasuredChild {
  Bounds box;
  std::uint32_t mask = 0;  // of all primitives
};

/// Builds the nodes over `primitives`, and brings these into the leaves' order. Access says what an
/// Access::Primitive p is: bounds_of(p), weight_of(p) (entries of a leaf, at most max_weight),
/// mask_of(p) (bits that a node tells of all below it), casts_shadow(p) and, where two centres are
/// equal, precedes(p, q), so that the same input gives the same hierarchy everywhere. Access::Cuts
/// is NoCuts, or cuts primitives in two (spatial_split.h): a leaf then names its first primitive, in
/// place of its first entry. Nodes::Node has four numbers `child` (child.h), and
/// Nodes::make(box, children) returns one in which these are left open. Several threads may build
/// different ranges at the same time.
template <class Access, class Nodes>
class Builder {
 public:
  using Node = typename Nodes::Node;
  using Primitive = typename Access::Primitive;
  using Cuts = typename Access::Cuts;
  /// Consecutive primitives.
  struct Range {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t first = 0, weight = 0;  // the entries of the leaves
    Bounds box, centres{};                // of the primitives, and of their centres
    std::uint32_t mask = 0;               // of all primitives
    std::uint32_t casting = 0;            // primitives that cast shadows
    // A range keeps `room` free places behind `end` for what Cuts may cut, and may make as many cuts,
    // of which `next_cut` is the first.
    std::uint32_t room = 0, next_cut = 0;
    std::uint32_t size() const { return end - begin; }
    bool mixed() const { return casting > 0 && casting < size(); }
  };
  struct Children {
    std::array<Range, 4> range;
    std::uint32_t count = 0;
  };

  /// A leaf has at most `max_leaf` entries, twice the weight of a primitive or more.
  Builder(std::span<Primitive> primitives, std::uint32_t max_leaf, const Cuts& cuts = {})
      : primitives_(primitives), max_leaf_(max_leaf), cuts_(cuts) {}

  /// Returns the primitives from `begin` on, whose entries in leaves are those from `first` on.
  Range measure(std::uint32_t begin, std::uint32_t end, std::uint32_t first) const {
    Range r;
    r.begin = begin;
    r.end = end;
    r.first = first;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Bounds box = Access::bounds_of(primitives_[i]);
      r.box.grow(box);
      r.centres.grow(box.centre());
      r.weight += Access::weight_of(primitives_[i]);
      r.mask |= Access::mask_of(primitives_[i]);
      r.casting += Access::casts_shadow(primitives_[i]);
    }
    return r;
  }

  bool is_leaf(const Range& r) const { return r.weight <= max_leaf_; }
  std::uint32_t make_leaf(const Range& r) const { return hierarchy::make_leaf(r.first, r.weight); }

  /// Splits a range that is no leaf into up to four, the largest first, as shadow rays visit them:
  /// a larger child is likelier to end them. Its own node has room for `stack` deferred entries.
  Children split_in_four(const Range& r, std::uint32_t stack) {
    // A child may get nearly everything. Where the stack is too small for that, all four get
    // equally many.
    const bool median =
        find_needed_stack(r.size() + r.room, max_leaf_ / Access::max_weight) + 3 > stack;
    Children children{{r}, 1};
    auto& [range, count] = children;
    while (count < 4) {
      std::size_t widest = count;
      for (std::size_t i = 0; i < count; ++i) {
        // A range is worth splitting if it is too big for a leaf, or cheaper as two leaves than as
        // one.
        if (range[i].weight <= (count == 1 ? max_leaf_ : std::max(1u, max_leaf_ / 2))) continue;
        const auto larger = [&](const Range& a, const Range& b) {
          return median ? a.size() > b.size() : a.box.half_area() > b.box.half_area();
        };
        if (widest == count || larger(range[i], range[widest])) widest = i;
      }
      if (widest == count) break;
      const auto [left, right] = split(range[widest], median);
      range[widest] = left;
      range[count++] = right;
    }
    for (std::size_t i = 1; i < count; ++i)  // by insertion: stable, and they are four
      for (std::size_t k = i; k > 0 && range[k - 1].box.half_area() < range[k].box.half_area(); --k)
        std::swap(range[k - 1], range[k]);
    return children;
  }

  /// Returns the node of a range, without the indices of its children.
  static Node make_node(const Range& r, const Children& children) {
    std::array<MeasuredChild, 4> measured;
    for (std::size_t i = 0; i < children.count; ++i)
      measured[i] = {children.range[i].box, children.range[i].mask};
    return Nodes::make(r.box, std::span<const MeasuredChild>(measured.data(), children.count));
  }

  /// Appends the nodes of a range and returns its root. `stack_need` gets the entries that a ray
  /// may have to defer, at most `stack`.
  std::uint32_t build(const Range& r, std::uint32_t stack, LargeVector<Node>& nodes,
                      std::uint32_t& stack_need) {
    stack_need = 0;
    if (is_leaf(r)) return make_leaf(r);
    const Children children = split_in_four(r, stack);
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(make_node(r, children));
    std::uint32_t deepest = 0;
    for (std::size_t i = 0; i < children.count; ++i) {
      std::uint32_t need = 0;
      const std::uint32_t child =
          build(children.range[i], stack - (children.count - 1), nodes, need);
      nodes[index].child[i] = child;
      deepest = std::max(deepest, need);
    }
    stack_need = children.count - 1 + deepest;
    return index;
  }

 private:
  std::pair<Range, Range> split(const Range& r, bool median) {
    const auto halves = split_whole(r, median);
    if constexpr (Cuts::may_cut) return median ? share_room(halves) : cut_or_keep(r, halves);
    return halves;
  }

  // Splits a range between primitives.
  std::pair<Range, Range> split_whole(const Range& r, bool median) {
    if (r.mixed() && !median) {  // then no shadow ray tests boxes of what casts none
      const auto begin = primitives_.begin() + r.begin, end = primitives_.begin() + r.end;
      const auto at = r.begin + static_cast<std::uint32_t>(
                                    std::partition(begin, end, Access::casts_shadow) - begin);
      return measure_halves(r, at);
    }
    if (!median && r.size() <= max_small_split) return split_few(r);
    if (!median)
      if (const BinnedSplit<Access> best(primitives_.subspan(r.begin, r.size()), r.centres);
          best.is_found())
        return measure_halves(r, partition(r, [&](const Primitive& p) { return best.is_left(p); }));
    return measure_halves(r, split_at_median(r));
  }

  // Cuts primitives of a range, where that is better than its halves; both get room for more.
  std::pair<Range, Range> cut_or_keep(const Range& r, const std::pair<Range, Range>& halves) {
    const auto& [left, right] = halves;
    Range whole = r;
    const auto middle = cuts_.split(primitives_, whole, left, right);
    return share_room(middle ? measure_halves(whole, *middle) : halves);
  }

  // Gives each half that may be cut room by its size, behind its primitives: those of the right half
  // move.
  std::pair<Range, Range> share_room(std::pair<Range, Range> halves) {
    auto& [left, right] = halves;
    const std::uint32_t of_left = Cuts::find_share(right.room, left, right);
    const std::uint32_t moved = std::min(of_left, right.size());
    std::copy_n(primitives_.begin() + right.begin, moved,
                primitives_.begin() + (right.end + of_left - moved));
    left.room = of_left;
    right.room -= of_left;
    right.next_cut += of_left;
    right.begin += of_left;
    right.end += of_left;
    left.first = left.begin;
    right.first = right.begin;
    return halves;
  }

  // Splits where the sum of area times weight is smallest over all positions in the orders of their
  // centres along the three axes.
  std::pair<Range, Range> split_few(const Range& r) {
    SmallSplit small;
    for (std::uint32_t i = 0; i < r.size(); ++i) {
      const Primitive& p = primitives_[r.begin + i];
      small.add(Access::bounds_of(p), Access::weight_of(p));
    }
    const std::uint32_t middle = r.begin + small.find();
    std::array<Primitive, max_small_split> before;
    std::copy_n(primitives_.begin() + r.begin, r.size(), before.begin());
    for (std::uint32_t i = 0; i < r.size(); ++i)
      primitives_[r.begin + i] = before[small.order()[i]];
    return measure_halves(r, middle);
  }

  std::pair<Range, Range> measure_halves(const Range& r, std::uint32_t middle) const {
    Range left = measure(r.begin, middle, r.first),
          right = measure(middle, r.end, r.first + left.weight);
    left.next_cut = right.next_cut = r.next_cut;
    right.room = r.room;
    return {left, right};
  }

  // Moves the primitives for which `is_left` holds before the others, and returns the position of
  // the first of those. Each is moved, without a branch, half of which would be mispredicted.
  template <class IsLeft>
  std::uint32_t partition(const Range& r, IsLeft is_left) {
    Primitive* const all = primitives_.data();
    std::uint32_t middle = r.begin;
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      const Primitive p = all[i];
      all[i] = all[middle];
      all[middle] = p;
      middle += is_left(p) ? 1 : 0;
    }
    return middle;
  }

  std::uint32_t split_at_median(const Range& r) {
    const Float4 size = r.centres.upper - r.centres.lower;
    const int longest =
        size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
    const std::uint32_t middle = r.begin + r.size() / 2;
    std::nth_element(primitives_.begin() + r.begin, primitives_.begin() + middle,
                     primitives_.begin() + r.end, [&](const Primitive& a, const Primitive& b) {
                       const float left = Access::bounds_of(a).centre()[longest],
                                   right = Access::bounds_of(b).centre()[longest];
                       return left != right ? left < right : Access::precedes(a, b);
                     });
    return middle;
  }

  std::span<Primitive> primitives_;
  std::uint32_t max_leaf_;
  Cuts cuts_;
};

}  // namespace nightcity::hierarchy
