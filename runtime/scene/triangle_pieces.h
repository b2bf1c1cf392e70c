// The pieces that a BVH over triangles is built of (formats/hierarchy/triangle_pieces.h).
#pragma once

#include <cstddef>

#include "formats/hierarchy/triangle_pieces.h"
#include "formats/large_vector.h"
#include "runtime/scene/triangle_list.h"

namespace nightcity::scene {

/// Returns the pieces of `count` triangles from `first` on, in their order; numbers count from
/// `first` on. `pairs` and `frame` are as append_pieces has them. `box` grows by the triangles, in
/// the scene's own frame. `large`: gets the triangles that may be cut; null = none may.
LargeVector<hierarchy::TrianglePiece> make_pieces(
    const TriangleList& triangles, std::size_t first, std::size_t count, bool pairs,
    const hierarchy::BoxFrame& frame, unsigned threads, hierarchy::Bounds& box,
    LargeVector<hierarchy::PackedCorners>* large = nullptr);

}  // namespace nightcity::scene
