// Large triangles of a hierarchy are cut where that keeps boxes apart (spatial splits: Stich,
// Friedrich, Dietrich, Spatial splits in bounding volume hierarchies, HPG 2009). Only boxes are cut:
// each part is the whole triangle again, in a leaf of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/hierarchy/box_frame.h"
#include "formats/hierarchy/child.h"

namespace nightcity::hierarchy {

/// Cuts a part at a plane. Of a hierarchy over n triangles, the parts 0 to n - 1 are these; cut k
/// makes part n + 2k, which lies below the plane, and n + 2k + 1, which lies above.
struct Cut {
  std::uint32_t part : 30;
  std::uint32_t axis : 2;
  float plane_m;  // in the frame of the boxes
};
static_assert(sizeof(Cut) == 8, "as in the file (SPEC.md, 2.6)");
constexpr std::uint32_t no_axis = 3;  // of a cut that was not made
constexpr std::uint32_t part_mask = (1u << 30) - 1;

/// All parts have numbers below this, since an entry of the order has as many bits.
constexpr std::uint64_t most_parts = std::uint64_t{1} << leaf_count_shift;

/// Returns the boxes of what lies below and above a plane, of the part of a triangle that is inside
/// `box`; none where all of it lies on one side. Both are inside `box`, and wider than the part by
/// what rounding may take.
std::optional<std::pair<Bounds, Bounds>> cut_box(const Corners& triangle, const Bounds& box,
                                                 int axis, float plane_m);

/// Reads the cuts of a hierarchy over `triangles` triangles. Returns why they are refused, "" where
/// they are not: a part that is not there or was cut before, an axis or a plane that is none, or
/// more cuts than triangles.
std::string decode_cuts(std::span<const std::byte> bytes, std::uint32_t triangles,
                        std::vector<Cut>& cuts);

}  // namespace nightcity::hierarchy
