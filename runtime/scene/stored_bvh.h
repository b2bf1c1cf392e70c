// The nodes of a hierarchy whose order and topology a scene file holds: only its boxes are measured.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "formats/stored_hierarchy.h"
#include "runtime/scene/bvh.h"

namespace nightcity::scene {

/// Appends the nodes of a stored hierarchy over the triangles from `first` on, as append_bvh does,
/// and sets `root`. `order` is as long as there are triangles, and one more for each cut: where it
/// cuts a triangle, each part is a position of that triangle. Its boxes are those of `frame`. The
/// result does not depend on the number of threads. Returns why the hierarchy does not fit these
/// triangles, and appends no node then; "" where it does. Nothing of it is trusted: whatever it
/// holds, all of each triangle is in leaves inside the boxes above them, and no ray defers more than
/// `max_stack` entries.
std::string append_stored_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                              std::size_t first, const StoredHierarchy& stored,
                              std::uint32_t max_leaf, std::uint32_t max_stack, unsigned threads,
                              std::span<std::uint32_t> order, BvhRoot& root,
                              const hierarchy::BoxFrame& frame = {}, std::size_t more_before = 0);

}  // namespace nightcity::scene
