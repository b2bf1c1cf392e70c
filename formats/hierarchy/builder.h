// Splits primitives by the binned surface-area heuristic (SAH), in place: Wald, On fast
// construction of SAH-based bounding volume hierarchies, 2007.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

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

/// A child of a node, as the builder has measured it.
struct MeasuredChild {
  Bounds box;
  std::uint32_t mask = 0;  // of all primitives
};

/// Builds the nodes over `primitives`, and brings these into the leaves' order. Access says what an
/// Access::Primitive p is: bounds_of(p), weight_of(p) (entries of a leaf, at most max_weight),
/// mask_of(p) (bits that a node tells of all below it), casts_shadow(p) and, where two centres are
/// equal, precedes(p, q), so that the same input gives the same hierarchy everywhere. Nodes::Node
/// has four numbers `child` (child.h), and Nodes::make(box, children) returns one in which these
/// are left open. Several threads may build different ranges at the same time.
template <class Access, class Nodes>
class Builder {
 public:
  using Node = typename Nodes::Node;
  using Primitive = typename Access::Primitive;
  /// Consecutive primitives.
  struct Range {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t first = 0, weight = 0;  // the entries of the leaves
    Bounds box, centres{};                // of the primitives, and of their centres
    std::uint32_t mask = 0;               // of all primitives
    std::uint32_t casting = 0;            // primitives that cast shadows
    std::uint32_t size() const { return end - begin; }
    bool mixed() const { return casting > 0 && casting < size(); }
  };
  struct Children {
    std::array<Range, 4> range;
    std::uint32_t count = 0;
  };

  /// A leaf has at most `max_leaf` entries, twice the weight of a primitive or more.
  Builder(std::span<Primitive> primitives, std::uint32_t max_leaf)
      : primitives_(primitives), max_leaf_(max_leaf) {}

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
    const bool median = find_needed_stack(r.size(), max_leaf_ / Access::max_weight) + 3 > stack;
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
  static constexpr std::size_t max_bins = 64;
  // With few primitives, most of 64 bins would be empty, and with very few sorting them is faster.
  static constexpr std::uint32_t few = 24;
  static constexpr std::size_t few_bins = 8;

  // Maps centres to bins, on all axes at once.
  struct Binning {
    Float4 lower, scale{};
    std::size_t bins;
    explicit Binning(const Range& r)
        : lower(r.centres.lower), bins(r.size() < few ? few_bins : max_bins) {
      const Float4 extent = r.centres.upper - r.centres.lower;
      for (int axis = 0; axis < 3; ++axis) {
        const float per_m = static_cast<float>(bins) / extent[axis];
        scale[axis] = extent[axis] > 0 && std::isfinite(per_m) ? per_m : 0.0f;
      }
    }
    Int4 place(Float4 centre) const {
      const float last = static_cast<float>(bins - 1);
      return to_int(
          min_of(max_of((centre - lower) * scale, Float4{}), Float4{last, last, last, 0}));
    }
  };
  struct Bin {
    Bounds box;
    std::uint32_t weight = 0;
  };
  struct Split {
    int axis = -1;
    std::size_t bin = 0;  // of the right half's first
  };

  std::pair<Range, Range> split(const Range& r, bool median) {
    if (r.mixed() && !median) {  // then no shadow ray tests boxes of what casts none
      const auto begin = primitives_.begin() + r.begin, end = primitives_.begin() + r.end;
      const auto at = r.begin + static_cast<std::uint32_t>(
                                    std::partition(begin, end, Access::casts_shadow) - begin);
      return measure_halves(r, at);
    }
    if (!median && r.size() <= max_small_split) return split_few(r);
    const Binning binning(r);
    const Split best = median           ? Split{}
                       : r.size() < few ? find_split<few_bins>(r, binning)
                                        : find_split<max_bins>(r, binning);
    if (best.axis >= 0) {
      // As Binning::place, on one axis: truncation to below a whole number is being below it.
      const float lower = binning.lower[best.axis], scale = binning.scale[best.axis],
                  bin = static_cast<float>(best.bin);
      const std::uint32_t at = partition(r, [&](const Primitive& p) {
        return (Access::bounds_of(p).centre()[best.axis] - lower) * scale < bin;
      });
      return measure_halves(r, at);
    }
    return measure_halves(r, split_at_median(r));
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
    const Range left = measure(r.begin, middle, r.first);
    return {left, measure(middle, r.end, r.first + left.weight)};
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

  // Finds the split with the smallest sum of area times weight over both halves.
  template <std::size_t bin_count>
  Split find_split(const Range& r, const Binning& binning) const {
    std::array<std::array<Bin, bin_count>, 3> bins;
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      const Bounds box = Access::bounds_of(primitives_[i]);
      const Int4 place = binning.place(box.centre());
      const std::uint32_t weight = Access::weight_of(primitives_[i]);
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(place[axis])];
        bin.box.grow(box);
        bin.weight += weight;
      }
    }
    float best_cost = INFINITY;
    Split best;
    for (int axis = 0; axis < 3; ++axis)
      if (binning.scale[axis] > 0)
        try_axis(std::span<const Bin, bin_count>(bins[static_cast<std::size_t>(axis)]), axis,
                 best_cost, best);
    return best;
  }

  template <std::size_t count>
  static void try_axis(std::span<const Bin, count> bins, int axis, float& best_cost, Split& best) {
    std::array<float, count> right_cost{};
    Bounds right;
    std::uint32_t rights = 0;
    for (std::size_t bin = count - 1; bin > 0; --bin) {
      if (bins[bin].weight > 0) {
        right.grow(bins[bin].box);
        rights += bins[bin].weight;
      }
      if (rights > 0) right_cost[bin] = right.half_area() * static_cast<float>(rights);
    }
    const std::uint32_t all = rights + bins[0].weight;
    Bounds left;
    std::uint32_t lefts = 0;
    for (std::size_t bin = 1; bin < count; ++bin) {
      if (bins[bin - 1].weight == 0) continue;  // the split before costs the same
      left.grow(bins[bin - 1].box);
      lefts += bins[bin - 1].weight;
      if (lefts == all) break;
      const float cost = left.half_area() * static_cast<float>(lefts) + right_cost[bin];
      if (!(cost < best_cost)) continue;
      best_cost = cost;
      best = {axis, bin};
    }
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
};

}  // namespace nightcity::hierarchy
