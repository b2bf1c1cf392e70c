// Splits primitives by the binned surface-area heuristic (SAH), in place: Wald, On fast construction
// of SAH-based bounding volume hierarchies, 2007.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "runtime/scene/bounds.h"
#include "runtime/scene/bvh.h"
#include "runtime/scene/bvh_node.h"

namespace nightcity::scene {

/// Builds the nodes over `primitives`, and brings these into the leaves' order. Access says what an
/// Access::Primitive p is: bounds_of(p), Access::mask_of(p) (MASK_* bits; has_masks: they differ) and, where
/// two centres are equal, precedes(p, q), so that the same input gives the same BVH everywhere.
/// Several threads may build different ranges at the same time.
template <class Access>
class BvhBuilder {
 public:
  using Primitive = typename Access::Primitive;
  /// Consecutive primitives.
  struct Range {
    std::uint32_t begin = 0, end = 0;
    Bounds box, centres{};   // of the primitives, and of their centres
    std::uint32_t mask = 0;  // of all primitives
    bool mixed = false;      // some of them cast shadows and some do not
    std::uint32_t size() const { return end - begin; }
  };
  struct Children {
    std::array<Range, 4> range;
    std::uint32_t count = 0;
  };

  /// Positions in leaves count from `first` on.
  BvhBuilder(std::span<Primitive> primitives, std::uint32_t max_leaf, std::uint32_t first)
      : primitives_(primitives), max_leaf_(max_leaf), first_(first) {}

  Range measure(std::uint32_t begin, std::uint32_t end) const {
    Range r{begin, end, {}};
    std::uint32_t casting = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Bounds box = Access::bounds_of(primitives_[i]);
      r.box.grow(box);
      r.centres.grow(box.centre());
      r.mask |= Access::mask_of(primitives_[i]);
      casting += casts_shadow(primitives_[i]);
    }
    r.mixed = casting > 0 && casting < r.size();
    return r;
  }

  bool is_leaf(const Range& r) const { return r.size() <= max_leaf_; }
  std::uint32_t make_leaf(const Range& r) const {
    return BVH_LEAF | ((r.size() - 1) << BVH_LEAF_COUNT_SHIFT) | (first_ + r.begin);
  }

  /// Splits a range that is no leaf into up to four, the largest first, as shadow rays visit them: a
  /// larger child is likelier to end them. Its own node has room for `stack` deferred entries.
  Children split_in_four(const Range& r, std::uint32_t stack) {
    // A child may get nearly everything. Where the stack is too small for that, all four get
    // equally many.
    const bool median = needed_stack(r.size(), max_leaf_) + 3 > stack;
    Children children{{r}, 1};
    auto& [range, count] = children;
    while (count < 4) {
      std::size_t widest = count;
      for (std::size_t i = 0; i < count; ++i) {
        // A range is worth splitting if it is too big for a leaf, or cheaper as two leaves than as
        // one.
        if (range[i].size() <= (count == 1 ? max_leaf_ : std::max(1u, max_leaf_ / 2))) continue;
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
  static gpu::BvhNode make_node(const Range& r, const Children& children) {
    std::array<BvhChild, 4> quantised;
    for (std::size_t i = 0; i < children.count; ++i)
      quantised[i] = {children.range[i].box.to_box(), children.range[i].mask};
    return quantise_node(r.box.to_box(), std::span(quantised.data(), children.count));
  }

  /// Appends the nodes of a range and returns its root. `stack_need` gets the entries that a ray may
  /// have to defer, at most `stack`.
  std::uint32_t build(const Range& r, std::uint32_t stack, std::vector<gpu::BvhNode>& nodes,
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
  static constexpr std::size_t max_bins = 16;
  // With few primitives, most of 16 bins would be empty.
  static constexpr std::uint32_t few = 24;

  // Maps centres to bins, on all axes at once.
  struct Binning {
    Float4 lower, scale{};
    std::size_t bins;
    explicit Binning(const Range& r) : lower(r.centres.lower), bins(r.size() < few ? 8 : max_bins) {
      const Float4 extent = r.centres.upper - r.centres.lower;
      for (int axis = 0; axis < 3; ++axis) {
        const float per_m = static_cast<float>(bins) / extent[axis];
        scale[axis] = extent[axis] > 0 && std::isfinite(per_m) ? per_m : 0.0f;
      }
    }
    Float4 place(Float4 centre) const {
      const float last = static_cast<float>(bins - 1);
      return min_of(max_of((centre - lower) * scale, Float4{}), Float4{last, last, last, 0});
    }
  };
  struct Bin {
    Bounds box;
    std::uint32_t count = 0;
  };
  using Bins = std::array<std::array<Bin, max_bins>, 3>;
  struct Split {
    int axis = -1;
    std::size_t bin = 0;  // of the right half's first
    Bounds left, right;
  };

  static bool casts_shadow(const Primitive& p) { return (Access::mask_of(p) & MASK_SHADOW) != 0; }

  std::pair<Range, Range> split(const Range& r, bool median) {
    if (r.mixed && !median) {  // then no shadow ray tests boxes of what casts none
      Bounds ignored;
      const std::uint32_t at = partition(
          r, [](const Primitive& p, Float4) { return casts_shadow(p); }, ignored, ignored);
      return {measure(r.begin, at), measure(at, r.end)};
    }
    const Binning binning(r);
    const Split best = median ? Split{} : find_split(r, binning);
    if (best.axis >= 0) {
      Range left{r.begin, 0, best.left, {}, r.mask}, right{0, r.end, best.right, {}, r.mask};
      const auto is_left = [&](const Primitive&, Float4 centre) {
        return static_cast<std::size_t>(binning.place(centre)[best.axis]) < best.bin;
      };
      left.end = right.begin = partition(r, is_left, left.centres, right.centres);
      if constexpr (Access::has_masks)
        return {measure(left.begin, left.end), measure(right.begin, right.end)};
      return {left, right};
    }
    const std::uint32_t middle = split_at_median(r);
    return {measure(r.begin, middle), measure(middle, r.end)};
  }

  // Moves the primitives for which `is_left(primitive, centre)` holds before the others, and returns
  // the position of the first of those. Grows the two boxes by the centres.
  template <class IsLeft>
  std::uint32_t partition(const Range& r, IsLeft is_left, Bounds& left, Bounds& right) {
    const auto test = [&](const Primitive& p) {
      const Float4 centre = Access::bounds_of(p).centre();
      const bool result = is_left(p, centre);
      (result ? left : right).grow(centre);
      return result;
    };
    std::uint32_t i = r.begin, j = r.end;
    while (true) {
      while (i < j && test(primitives_[i])) ++i;
      if (i == j) return i;
      do {
        if (--j == i) return i;
      } while (!test(primitives_[j]));
      std::swap(primitives_[i++], primitives_[j]);
    }
  }

  // Finds the split with the smallest sum of area times number over both halves.
  Split find_split(const Range& r, const Binning& binning) const {
    Bins bins;
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      const Bounds box = Access::bounds_of(primitives_[i]);
      const Float4 place = binning.place(box.centre());
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(place[axis])];
        bin.box.grow(box);
        ++bin.count;
      }
    }
    float best_cost = INFINITY;
    Split best;
    for (int axis = 0; axis < 3; ++axis)
      if (binning.scale[axis] > 0)
        try_axis(bins[static_cast<std::size_t>(axis)], axis, binning.bins, best_cost, best);
    return best;
  }

  static void try_axis(const std::array<Bin, max_bins>& bins, int axis, std::size_t count,
                       float& best_cost, Split& best) {
    std::array<float, max_bins> right_cost{};
    std::array<Bounds, max_bins> right_box;
    Bounds right;
    std::uint32_t rights = 0;
    for (std::size_t bin = count - 1; bin > 0; --bin) {
      if (bins[bin].count > 0) {
        right.grow(bins[bin].box);
        rights += bins[bin].count;
      }
      if (rights > 0) right_cost[bin] = right.half_area() * static_cast<float>(rights);
      right_box[bin] = right;
    }
    const std::uint32_t all = rights + bins[0].count;
    Bounds left;
    std::uint32_t lefts = 0;
    for (std::size_t bin = 1; bin < count; ++bin) {
      if (bins[bin - 1].count == 0) continue;  // the split before costs the same
      left.grow(bins[bin - 1].box);
      lefts += bins[bin - 1].count;
      if (lefts == all) break;
      const float cost = left.half_area() * static_cast<float>(lefts) + right_cost[bin];
      if (!(cost < best_cost)) continue;
      best_cost = cost;
      best = {axis, bin, left, right_box[bin]};
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
  std::uint32_t max_leaf_, first_;
};

}  // namespace nightcity::scene
