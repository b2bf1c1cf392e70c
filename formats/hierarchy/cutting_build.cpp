#include "formats/hierarchy/cutting_build.h"

#include <algorithm>

#include "formats/hierarchy/static_geometry.h"

namespace nightcity::hierarchy {

std::uint32_t find_room(std::size_t triangles) {
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(triangles / 2, (most_parts - triangles) / 2));
}

LeafNumbers::LeafNumbers(std::span<const TrianglePiece> pieces, std::uint32_t triangles,
                         std::span<const Cut> made, std::uint32_t position)
    : pieces_(pieces), triangles_(triangles), position_(position) {
  numbers_.reserve(made.size());
  for (const Cut& cut : made) {
    numbers_.push_back(static_cast<std::uint32_t>(parts_.cuts.size()));
    if (cut.axis == no_axis) continue;
    // A part is cut by a later cut than the one that made it.
    parts_.cuts.push_back({find_number(cut.part) & part_mask, cut.axis, cut.plane_m});
  }
  parts_.order.reserve(triangles + parts_.cuts.size());
}

std::uint32_t LeafNumbers::find_number(std::uint32_t part) const {
  if (part < triangles_) return part;
  const std::uint32_t of_cuts = part - triangles_;
  return triangles_ + 2 * numbers_[of_cuts / 2] + of_cuts % 2;
}

void LeafNumbers::take(std::uint32_t& child) {
  if (child == no_child || !is_leaf(child)) return;
  const std::size_t first = parts_.order.size();
  const std::uint32_t size = size_of_leaf(child);
  for (std::size_t i = first_of_leaf(child); parts_.order.size() < first + size; ++i)
    if (pieces_[i].is_large())
      parts_.order.push_back(find_number(pieces_[i].first()));
    else
      for (std::uint32_t k = 0; k < pieces_[i].count(); ++k)
        parts_.order.push_back(pieces_[i].first() + k);
  child = make_leaf(position_ + static_cast<std::uint32_t>(first), size);
}

Encoded build_encoded(CutPieces pieces, std::uint32_t triangles, unsigned threads,
                      double& area_m2) {
  LargeVector<BareNode> nodes;
  LeafParts parts;
  const Root root = build_cutting<BareNodes>(std::move(pieces), triangles, static_leaf,
                                             static_stack, threads, 0, nodes, parts);
  area_m2 = 0;
  for (const BareNode& node : nodes) area_m2 += double(node.area);
  Encoded encoded = encode(nodes, root.node, parts.order);
  encoded.cuts = std::move(parts.cuts);
  return encoded;
}

}  // namespace nightcity::hierarchy
