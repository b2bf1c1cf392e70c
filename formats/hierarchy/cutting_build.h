// Builds hierarchies that cut large triangles (spatial_split.h), for files.
#pragma once

#include <cstddef>
#include <cstdint>

#include "formats/hierarchy/topology.h"
#include "formats/hierarchy/triangle_pieces.h"
#include "formats/large_vector.h"

namespace nightcity::hierarchy {

/// Pieces of triangles, and the corners of those that may be cut, as append_pieces makes them.
struct CutPieces {
  LargeVector<TrianglePiece> pieces;
  LargeVector<Corners> large;
};

/// Returns how many cuts a hierarchy may make: half as many as it has triangles, where numbers of
/// parts allow that. Room is shared before it is known where it is needed; a third of it is used.
std::uint32_t find_room(std::size_t triangles);

/// Builds the hierarchy of one piece or more, of so many triangles, and returns it as numbers.
/// `area_m2` gets half the surfaces of all children's boxes, summed. The result does not depend on
/// the number of threads.
Encoded build_with_cuts(CutPieces pieces, std::uint32_t triangles, unsigned threads,
                        double& area_m2);

}  // namespace nightcity::hierarchy
