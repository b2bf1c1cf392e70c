// Binned surface-area heuristic (SAH): Wald, On fast construction of SAH-based bounding volume
// hierarchies, 2007.
#include "runtime/scene/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "formats/error.h"
#include "runtime/scene/bvh_node.h"

namespace nightcity::scene {
namespace {

constexpr int bin_count = 16;

// Consecutive primitives in the order being made.
struct Range {
  std::uint32_t begin, end;
  Box box;
  std::uint32_t mask = 0;  // of all its primitives
  bool mixed = false;      // some of them cast shadows and some do not
  std::uint32_t size() const { return end - begin; }
};

class BinnedSahBuilder {
 public:
  BinnedSahBuilder(std::span<const Box> boxes, std::span<const std::uint8_t> masks,
                   std::uint32_t max_leaf)
      : boxes_(boxes), masks_(masks), max_leaf_(max_leaf) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0u);
    centres_.reserve(boxes.size());
    for (const Box& box : boxes) centres_.push_back(0.5f * box.lower + 0.5f * box.upper);
  }

  // `stack` >= needed_stack(boxes).
  Bvh build(std::uint32_t stack) {
    Bvh bvh;
    if (!boxes_.empty()) {
      const Range all = range(0, static_cast<std::uint32_t>(boxes_.size()));
      bvh.root = build(all, stack, bvh.stack_need);
    }
    bvh.nodes = std::move(nodes_);
    bvh.order = std::move(order_);
    return bvh;
  }

 private:
  Range range(std::uint32_t begin, std::uint32_t end) const {
    Range r{begin, end, {}};
    std::uint32_t casting = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      r.box.grow(boxes_[order_[i]]);
      r.mask |= mask_of(order_[i]);
      casting += casts_shadow(order_[i]);
    }
    r.mixed = casting > 0 && casting < r.size();
    return r;
  }

  std::uint32_t mask_of(std::uint32_t primitive) const {
    return masks_.empty() ? 0xFFu : masks_[primitive];
  }
  bool casts_shadow(std::uint32_t primitive) const {
    return (mask_of(primitive) & MASK_SHADOW) != 0;
  }

  static std::uint32_t leaf(const Range& r) {
    return BVH_LEAF | ((r.size() - 1) << BVH_LEAF_COUNT_SHIFT) | r.begin;
  }

  // Splits a range in two and returns the position of the right half's first primitive.
  std::uint32_t split(const Range& r, bool median) {
    if (r.mixed && !median) {  // then no shadow ray tests boxes of what casts none
      const auto middle = std::stable_partition(order_.begin() + r.begin, order_.begin() + r.end,
                                                [&](std::uint32_t i) { return casts_shadow(i); });
      return static_cast<std::uint32_t>(middle - order_.begin());
    }
    Box centre_box;
    for (std::uint32_t i = r.begin; i < r.end; ++i) centre_box.grow(centres_[order_[i]]);
    const glm::vec3 size = centre_box.upper - centre_box.lower;
    const int longest = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    if (!median && size[longest] > 0) {
      const std::uint32_t at = split_by_area(r, centre_box);
      if (at != r.begin && at != r.end) return at;
    }
    const std::uint32_t middle = r.begin + r.size() / 2;
    std::nth_element(order_.begin() + r.begin, order_.begin() + middle, order_.begin() + r.end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       // Ties by index, so that the same input gives the same BVH everywhere.
                       return std::pair(centres_[a][longest], a) <
                              std::pair(centres_[b][longest], b);
                     });
    return middle;
  }

  // Splits where the sum of area times number over both halves is smallest; returns r.begin if no
  // split is possible.
  std::uint32_t split_by_area(const Range& r, const Box& centre_box) {
    float best_cost = INFINITY;
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centre_box.upper[axis] - centre_box.lower[axis];
      if (!(extent > 0)) continue;
      std::array<Box, bin_count> bins;
      std::array<std::uint32_t, bin_count> counts{};
      for (std::uint32_t i = r.begin; i < r.end; ++i) {
        const int bin = bin_of(centres_[order_[i]][axis], centre_box.lower[axis], extent);
        bins[static_cast<std::size_t>(bin)].grow(boxes_[order_[i]]);
        ++counts[static_cast<std::size_t>(bin)];
      }
      std::array<float, bin_count> right_cost{};
      Box right;
      std::uint32_t right_count = 0;
      for (std::size_t bin = bin_count - 1; bin > 0; --bin) {
        right.grow(bins[bin]);
        right_count += counts[bin];
        right_cost[bin] = right.half_area() * static_cast<float>(right_count);
      }
      Box left;
      std::uint32_t left_count = 0;
      for (std::size_t bin = 1; bin < bin_count; ++bin) {
        left.grow(bins[bin - 1]);
        left_count += counts[bin - 1];
        const float cost = left.half_area() * static_cast<float>(left_count) + right_cost[bin];
        if (left_count > 0 && left_count < r.size() && cost < best_cost) {
          best_cost = cost;
          best_axis = axis;
          best_bin = static_cast<int>(bin);
        }
      }
    }
    if (best_axis < 0) return r.begin;
    const float lower = centre_box.lower[best_axis];
    const float extent = centre_box.upper[best_axis] - lower;
    const auto middle = std::stable_partition(
        order_.begin() + r.begin, order_.begin() + r.end, [&](std::uint32_t primitive) {
          return bin_of(centres_[primitive][best_axis], lower, extent) < best_bin;
        });
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  static int bin_of(float centre, float lower, float extent) {
    return std::clamp(static_cast<int>((centre - lower) / extent * bin_count), 0, bin_count - 1);
  }

  std::uint32_t build(const Range& r, std::uint32_t stack, std::uint32_t& stack_need) {
    stack_need = 0;
    if (r.size() <= max_leaf_) return leaf(r);
    // A child may get nearly everything. Where the stack is too small for that, all four get
    // equally many.
    const bool median = needed_stack(r.size(), max_leaf_) + 3 > stack;
    std::array<Range, 4> children{r, {}, {}, {}};
    std::size_t count = 1;
    while (count < 4) {
      std::size_t widest = count;
      for (std::size_t i = 0; i < count; ++i) {
        // A range is worth splitting if it is too big for a leaf, or cheaper as two leaves than as
        // one.
        if (children[i].size() <= (count == 1 ? max_leaf_ : std::max(1u, max_leaf_ / 2))) continue;
        const auto larger = [&](const Range& a, const Range& b) {
          return median ? a.size() > b.size() : a.box.half_area() > b.box.half_area();
        };
        if (widest == count || larger(children[i], children[widest])) widest = i;
      }
      if (widest == count) break;
      const std::uint32_t at = split(children[widest], median);
      const Range right = range(at, children[widest].end);
      children[widest] = range(children[widest].begin, at);
      children[count++] = right;
    }
    // Shadow rays visit the children in this order: a larger one is likelier to end them.
    std::stable_sort(
        children.begin(), children.begin() + count,
        [](const Range& a, const Range& b) { return a.box.half_area() > b.box.half_area(); });
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    std::array<BvhChild, 4> quantised;
    for (std::size_t i = 0; i < count; ++i) quantised[i] = {children[i].box, children[i].mask};
    nodes_.push_back(quantise_node(r.box, std::span(quantised.data(), count)));
    std::uint32_t deepest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t need = 0;
      const std::uint32_t child =
          build(children[i], stack - (static_cast<std::uint32_t>(count) - 1), need);
      nodes_[index].child[i] = child;
      deepest = std::max(deepest, need);
    }
    stack_need = static_cast<std::uint32_t>(count) - 1 + deepest;
    return index;
  }

  std::span<const Box> boxes_;
  std::span<const std::uint8_t> masks_;
  std::uint32_t max_leaf_;
  std::vector<glm::vec3> centres_;
  std::vector<std::uint32_t> order_;
  std::vector<gpu::BvhNode> nodes_;
};

}  // namespace

std::uint32_t needed_stack(std::size_t boxes, std::uint32_t max_leaf) {
  std::uint32_t need = 0;
  for (; boxes > max_leaf; boxes = (boxes + 3) / 4) need += 3;
  return need;
}

Bvh build_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t max_stack,
              std::span<const std::uint8_t> masks) {
  if (boxes.size() > BVH_LEAF_FIRST_MASK)
    throw Error("", "more than 134 million triangles in one scene");
  if (needed_stack(boxes.size(), max_leaf) > max_stack)
    throw Error(
        "", "the scene has too many triangles in a mesh, or instances, for the traversal stack");
  return BinnedSahBuilder(boxes, masks, max_leaf).build(max_stack);
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
