#include "runtime/scene/triangle_parts.h"

namespace nightcity::scene {

using hierarchy::Bounds;
using hierarchy::Corners;

std::string TriangleParts::measure(std::span<const hierarchy::Cut> cuts,
                                   const TriangleList& triangles, std::size_t first,
                                   std::uint32_t count, const hierarchy::BoxFrame& frame) {
  end_ = static_cast<std::uint32_t>(first) + count;
  parts_.clear();
  parts_.reserve(2 * cuts.size());
  for (const hierarchy::Cut& cut : cuts) {
    const bool is_whole = cut.part < count;
    const std::uint32_t triangle =
        is_whole ? static_cast<std::uint32_t>(first) + cut.part : parts_[cut.part - count].first();
    Corners corners;
    triangles.copy_corners(triangle, std::span(&corners, 1));
    corners = frame.turn(corners);
    const Bounds box = is_whole ? corners.bounds() : parts_[cut.part - count].bounds();
    const auto halves = hierarchy::cut_box(corners, box, static_cast<int>(cut.axis), cut.plane_m);
    if (!halves) return "a cut misses its part";
    parts_.emplace_back(halves->first, triangle, 1);
    parts_.emplace_back(halves->second, triangle, 1);
  }
  return "";
}

TriangleParts::Found TriangleParts::replace(std::span<std::uint32_t> numbers) const {
  Found found;
  if (parts_.empty()) return found;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < end_) continue;
    const hierarchy::TrianglePiece& part = parts_[numbers[i] - end_];
    numbers[i] = part.first();
    found.emplace_back(i, part.bounds());
  }
  return found;
}

}  // namespace nightcity::scene
