// Splits boxes by the surface-area heuristic (SAH), at the ends of bins of equal width: Wald, On
// fast construction of SAH-based bounding volume hierarchies, 2007.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "formats/hierarchy/bounds.h"

namespace nightcity::hierarchy {

/// The split of some primitives with the smallest sum of area times weight over both halves. Access
/// is as Builder's (builder.h).
template <class Access>
class BinnedSplit {
 public:
  using Primitive = typename Access::Primitive;

  /// `centres`: the box of the centres of their boxes.
  BinnedSplit(std::span<const Primitive> primitives, const Bounds& centres)
      : lower_(centres.lower), bins_(primitives.size() < few ? few_bins : max_bins) {
    const Float4 extent = centres.upper - centres.lower;
    for (int axis = 0; axis < 3; ++axis) {
      const float per_m = static_cast<float>(bins_) / extent[axis];
      scale_[axis] = extent[axis] > 0 && std::isfinite(per_m) ? per_m : 0.0f;
    }
    if (primitives.size() < few)
      find<few_bins>(primitives);
    else
      find<max_bins>(primitives);
  }

  /// Returns whether there is one: where all centres are in one place there is none.
  bool is_found() const { return axis_ >= 0; }
  bool is_left(const Primitive& p) const {
    // As place(), on one axis: truncation to below a whole number is being below it.
    return (Access::bounds_of(p).centre()[axis_] - lower_[axis_]) * scale_[axis_] < right_;
  }

 private:
  static constexpr std::size_t max_bins = 64;
  // With few primitives, most of 64 bins would be empty, and with very few sorting them is faster.
  static constexpr std::size_t few = 24, few_bins = 8;

  struct Bin {
    Bounds box;
    std::uint32_t weight = 0;
  };

  // Returns the bins of a centre, on all axes at once.
  Int4 place(Float4 centre) const {
    const float last = static_cast<float>(bins_ - 1);
    return to_int(
        min_of(max_of((centre - lower_) * scale_, Float4{}), Float4{last, last, last, 0}));
  }

  template <std::size_t bin_count>
  void find(std::span<const Primitive> primitives) {
    std::array<std::array<Bin, bin_count>, 3> bins;
    for (const Primitive& p : primitives) {
      const Bounds box = Access::bounds_of(p);
      const Int4 at = place(box.centre());
      const std::uint32_t weight = Access::weight_of(p);
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(at[axis])];
        bin.box.grow(box);
        bin.weight += weight;
      }
    }
    for (int axis = 0; axis < 3; ++axis)
      if (scale_[axis] > 0)
        try_axis(std::span<const Bin, bin_count>(bins[static_cast<std::size_t>(axis)]), axis);
  }

  template <std::size_t count>
  void try_axis(std::span<const Bin, count> bins, int axis) {
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
      if (!(cost < cost_)) continue;
      cost_ = cost;
      axis_ = axis;
      right_ = static_cast<float>(bin);
    }
  }

  Float4 lower_, scale_{};
  std::size_t bins_;
  float cost_ = INFINITY;
  int axis_ = -1;
  float right_ = 0;  // the right half's first bin
};

}  // namespace nightcity::hierarchy
