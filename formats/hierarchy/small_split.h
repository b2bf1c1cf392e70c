// Splits a handful of boxes by the surface-area heuristic (SAH), all positions tried: most ranges
// of a hierarchy are that small, and there bins cost more than sorting does.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "formats/hierarchy/bounds.h"

namespace nightcity::hierarchy {

constexpr std::uint32_t max_small_split = 12;

class SmallSplit {
 public:
  /// At most max_small_split boxes, which are finite.
  void add(const Bounds& box, std::uint32_t weight) {
    const Float4 centre = box.lower + box.upper;
    Int4 rank{};
    for (std::uint32_t i = 0; i < count_; ++i) {
      const Int4 before = centre < boxes_[i].centre;  // -1 where the new one comes before
      boxes_[i].rank -= before;
      rank += before + 1;
    }
    boxes_[count_++] = {box.lower, box.upper, centre, rank, static_cast<float>(weight)};
  }

  /// Returns how many of order() are the left half: at least 1 and fewer than all. There must be
  /// two boxes or more. Of positions that cost the same, the one nearest to the middle is taken.
  std::uint32_t find() {
    best_middle_ = count_ / 2;
    for (std::uint32_t i = 0; i < count_; ++i)
      for (int axis = 0; axis < 3; ++axis)
        order_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(boxes_[i].rank[axis])] =
            static_cast<std::uint8_t>(i);
    if (count_ > 2)
      for (std::size_t axis = 0; axis < 3; ++axis) sweep(axis);
    return best_middle_;
  }

  /// Returns the positions of the boxes as they were added, in the order that is to be cut.
  std::span<const std::uint8_t> order() const { return {order_[best_axis_].data(), count_}; }

 private:
  struct Entry {
    Float4 lower, upper, centre;
    Int4 rank;  // among those added so far, by the centres on each axis
    float weight;
  };

  void sweep(std::size_t axis) {
    const auto& order = order_[axis];
    std::array<float, max_small_split> right_cost;
    Bounds right;
    float weight = 0;
    for (std::uint32_t i = count_ - 1; i > 0; --i) {
      const Entry& entry = boxes_[order[i]];
      right.grow({entry.lower, entry.upper});
      weight += entry.weight;
      right_cost[i] = weight * right.half_area();
    }
    Bounds left;
    weight = 0;
    for (std::uint32_t middle = 1; middle < count_; ++middle) {
      const Entry& entry = boxes_[order[middle - 1]];
      left.grow({entry.lower, entry.upper});
      weight += entry.weight;
      const float cost = weight * left.half_area() + right_cost[middle];
      const std::uint32_t off =
          middle < count_ - middle ? count_ - 2 * middle : 2 * middle - count_;
      if (!(cost < best_cost_ || (cost == best_cost_ && off < best_off_))) continue;
      best_cost_ = cost;
      best_off_ = off;
      best_middle_ = middle;
      best_axis_ = axis;
    }
  }

  std::uint32_t count_ = 0;
  std::array<Entry, max_small_split> boxes_;
  std::array<std::array<std::uint8_t, max_small_split>, 3> order_;
  float best_cost_ = INFINITY;
  std::uint32_t best_middle_ = 0, best_off_ = UINT32_MAX;
  std::size_t best_axis_ = 0;
};

}  // namespace nightcity::hierarchy
