// Spatial splits: a range of triangles is split by a plane, and those that it crosses are cut, where
// the two boxes of a split between whole triangles overlap much (Stich, Friedrich, Dietrich, Spatial
// splits in bounding volume hierarchies, HPG 2009). Streets and areas of land are long and thin, and
// lie at any angle, so that their boxes hold much that they do not. Planes are upright, since a city
// is wide and low.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "formats/hierarchy/cuts.h"
#include "formats/hierarchy/triangle_pieces.h"

namespace nightcity::hierarchy {

/// Cuts the pieces of large triangles (TrianglePiece::is_large), as Builder asks for it.
class TriangleCuts {
 public:
  static constexpr bool may_cut = true;
  /// Only halves whose boxes share half a surface above this are worth it, m2: some 30 m by 16 m.
  static constexpr float min_overlap_m2 = 500;

  TriangleCuts() = default;
  /// `large`: the corners of large triangles. A hierarchy is over `triangles` triangles, and `cuts`
  /// has room for as many as it may make; no_axis marks those that were not made. Boxes of pieces are
  /// `margin_m` wider than what they hold.
  TriangleCuts(std::span<const PackedCorners> large, std::uint32_t triangles, std::span<Cut> cuts,
               float margin_m)
      : large_(large), triangles_(triangles), cuts_(cuts), margin_m_(margin_m) {}

  /// Returns how much of `room` the left half gets: by its share of what rays pay, area times pieces.
  template <class Range>
  static std::uint32_t find_share(std::uint32_t room, const Range& left, const Range& right) {
    const auto pay = [](const Range& half) {
      const float area_m2 = half.box.half_area();
      return area_m2 > min_overlap_m2 ? double(area_m2) * double(half.size()) : 0.0;
    };
    const double of_left = pay(left), all = of_left + pay(right);
    return all > 0 ? static_cast<std::uint32_t>(room * (of_left / all)) : 0;
  }

  /// Splits a range by a plane if that is better than its halves, moves its pieces to their sides,
  /// and returns the first one of the right side. The range grows by what was cut, into its room.
  template <class Range>
  std::optional<std::uint32_t> split(std::span<TrianglePiece> pieces, Range& range,
                                     const Range& left, const Range& right) const {
    const Bounds shared{max_of(left.box.lower, right.box.lower),
                        min_of(left.box.upper, right.box.upper)};
    for (int axis = 0; axis < 3; ++axis)
      if (shared.lower[axis] > shared.upper[axis]) return std::nullopt;
    if (range.room == 0 || !(shared.half_area() > min_overlap_m2)) return std::nullopt;
    Plane best{weigh(left) + weigh(right)};
    const auto all = pieces.subspan(range.begin, range.size());
    for (const int axis : {0, 2}) try_axis(all, range, axis, best);
    if (best.axis < 0) return std::nullopt;
    return move(pieces, range, best);
  }

 private:
  static constexpr std::size_t bin_count = 16;
  // Planes are chosen by so many pieces of a range, at equal steps, or up to twice as many. With all
  // of them, boxes came out as large, and took half as long again to build.
  static constexpr std::size_t enough_pieces = 512;
  struct Bin {
    Bounds box;                         // of what lies in it
    std::uint32_t first = 0, last = 0;  // triangles of which it is the first bin, the last one
  };
  // Bins of equal width along an axis of a range.
  struct Bins {
    int axis;
    float lower, width, per_m;
    Bins(const Bounds& box, int along)
        : axis(along),
          lower(box.lower[along]),
          width((box.upper[along] - lower) / static_cast<float>(bin_count)),
          per_m(1 / width) {}
    std::size_t place(float at_m) const {
      const float bin = (at_m - lower) * per_m;
      return static_cast<std::size_t>(
          static_cast<int>(std::clamp(bin, 0.0f, static_cast<float>(bin_count - 1))));
    }
    float lower_end(std::size_t bin) const { return lower + width * static_cast<float>(bin); }
  };
  struct Plane {
    float cost;  // area times weight of both sides
    int axis = -1;
    std::size_t bin = 0;  // of the right side's first
  };

  template <class Range>
  static float weigh(const Range& r) {
    return r.box.half_area() * static_cast<float>(r.weight);
  }

  template <class Range>
  void try_axis(std::span<const TrianglePiece> pieces, const Range& range, int axis,
                Plane& best) const {
    const Bins bins(range.box, axis);
    if (!(bins.width > 0 && std::isfinite(bins.per_m))) return;
    std::array<Bin, bin_count> all;
    std::uint32_t weight = 0;
    for (std::size_t i = 0; i < pieces.size(); i += 1 + pieces.size() / enough_pieces) {
      const TrianglePiece& piece = pieces[i];
      weight += piece.weight();
      const Bounds box = piece.bounds();
      std::size_t first = bins.place(box.lower[axis]), last = bins.place(box.upper[axis]);
      if (!piece.is_large()) first = last = bins.place(box.centre()[axis]);
      all[first].first += piece.weight();
      all[last].last += piece.weight();
      if (first == last)
        all[first].box.grow(box);
      else
        add_slices(large_[piece.large()].unpack(), box, bins, first, last, all);
    }
    std::array<float, bin_count> right_area{};
    Bounds right;
    for (std::size_t bin = bin_count - 1; bin > 0; --bin) {
      right.grow(all[bin].box);
      if (right.lower[0] <= right.upper[0]) right_area[bin] = right.half_area();
    }
    const float scale = static_cast<float>(range.weight) / static_cast<float>(weight);
    std::uint32_t lefts = 0, rights = weight;
    Bounds box;
    for (std::size_t bin = 1; bin < bin_count; ++bin) {
      box.grow(all[bin - 1].box);
      lefts += all[bin - 1].first;
      rights -= all[bin - 1].last;
      if (lefts == 0 || rights == 0) continue;
      if (static_cast<float>(lefts + rights - weight) * scale > static_cast<float>(range.room))
        continue;
      const float cost = (box.half_area() * static_cast<float>(lefts) +
                          right_area[bin] * static_cast<float>(rights)) *
                         scale;
      if (cost < best.cost) best = {cost, axis, bin};
    }
  }

  // Grows bins by the slices of the part of a triangle that is in `box`, from its first bin to its
  // last: corners, and places where edges cross the ends of bins. A slice may reach out of the part,
  // but not out of `box`: what is cut is measured again.
  static void add_slices(const Corners& triangle, const Bounds& box, const Bins& bins,
                         std::size_t first, std::size_t last, std::array<Bin, bin_count>& all) {
    std::array<Bounds, bin_count> slices;
    const int axis = bins.axis;
    const float lower_m = box.lower[axis], upper_m = box.upper[axis];
    const Float4 corners[] = {triangle.v0, triangle.v1, triangle.v2, triangle.v0};
    for (int i = 0; i < 3; ++i) {
      const bool rises = corners[i][axis] < corners[i + 1][axis];
      const Float4 low = corners[rises ? i : i + 1], high = corners[rises ? i + 1 : i];
      const float from = low[axis], to = high[axis];
      if (to < lower_m || from > upper_m) continue;
      const Float4 way = (high - low) * (to > from ? 1 / (to - from) : 0);
      const auto at = [&](float plane_m) { return low + (plane_m - from) * way; };
      const std::size_t begin = std::max(bins.place(from), first),
                        end = std::min(bins.place(to), last);
      slices[begin].grow(from < lower_m ? at(lower_m) : low);
      for (std::size_t bin = begin; bin < end; ++bin) {
        const Float4 crossing = at(bins.lower_end(bin + 1));
        slices[bin].grow(crossing);
        slices[bin + 1].grow(crossing);
      }
      slices[end].grow(to > upper_m ? at(upper_m) : high);
    }
    for (std::size_t bin = first; bin <= last; ++bin) {
      const Bounds slice{max_of(slices[bin].lower, box.lower),
                         min_of(slices[bin].upper, box.upper)};
      if (slice.lower[0] <= slice.upper[0] && slice.lower[1] <= slice.upper[1] &&
          slice.lower[2] <= slice.upper[2])
        all[bin].box.grow(slice);
    }
  }

  template <class Range>
  std::optional<std::uint32_t> move(std::span<TrianglePiece> pieces, Range& range,
                                    const Plane& best) const {
    const Bins bins(range.box, best.axis);
    const float plane_m = bins.lower_end(best.bin);
    std::uint32_t middle = range.begin;
    const std::uint32_t end = range.end;
    for (std::uint32_t i = range.begin; i < end; ++i)
      if (goes_left(pieces[i], bins, best.bin, plane_m, pieces, range))
        std::swap(pieces[i], pieces[middle++]);
    if (middle == range.begin || middle == range.end) middle = range.begin + range.size() / 2;
    return middle;
  }

  template <class Range>
  bool goes_left(TrianglePiece& piece, const Bins& bins, std::size_t right_bin, float plane_m,
                 std::span<TrianglePiece> pieces, Range& range) const {
    const Bounds box = piece.bounds();
    const float centre_m = box.centre()[bins.axis];
    if (!piece.is_large()) return bins.place(centre_m) < right_bin;
    if (box.upper[bins.axis] <= plane_m) return true;
    if (box.lower[bins.axis] >= plane_m) return false;
    return cut(piece, bins.axis, plane_m, pieces, range) || centre_m < plane_m;
  }

  // Cuts a piece that a plane crosses: it becomes what lies below, and the rest is appended to the
  // range. Returns whether it was cut.
  template <class Range>
  bool cut(TrianglePiece& piece, int axis, float plane_m, std::span<TrianglePiece> pieces,
           Range& range) const {
    if (range.room == 0) return false;
    const auto halves =
        cut_box(large_[piece.large()].unpack(), piece.bounds().widened(-margin_m_), axis, plane_m);
    if (!halves) return false;
    const std::uint32_t number = range.next_cut++, below = triangles_ + 2 * number;
    cuts_[number] = {piece.first() & part_mask, static_cast<std::uint32_t>(axis) & 3u, plane_m};
    const std::uint32_t mark = piece.count();
    piece = TrianglePiece(halves->first.widened(margin_m_), below, mark);
    pieces[range.end++] = TrianglePiece(halves->second.widened(margin_m_), below + 1, mark);
    --range.room;
    return true;
  }

  std::span<const PackedCorners> large_;
  std::uint32_t triangles_ = 0;
  std::span<Cut> cuts_;
  float margin_m_ = 0;
};

/// Builder asks these questions of pieces of one or two triangles, of which it cuts large ones.
struct CutPieceAccess : PieceAccess<2> {
  using Cuts = TriangleCuts;
  static std::uint32_t weight_of(const Primitive& p) { return p.weight(); }
};

}  // namespace nightcity::hierarchy
