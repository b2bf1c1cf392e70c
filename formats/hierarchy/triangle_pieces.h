// A hierarchy over triangles is built of single triangles and of pairs that share an edge. Walls,
// windows and streets are quads for the most part, so pairs halve the work.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/hierarchy/box_frame.h"
#include "formats/hierarchy/builder.h"
#include "formats/large_vector.h"

namespace nightcity::hierarchy {

/// One or two consecutive triangles, as their box. Their numbers are in its unused fourth places.
class TrianglePiece {
 public:
  TrianglePiece() = default;
  TrianglePiece(const Bounds& box, std::uint32_t first, std::uint32_t count)
      : lower_(put(box.lower, first)), upper_(put(box.upper, count)) {}

  Bounds bounds() const { return {take_xyz(lower_), take_xyz(upper_)}; }
  std::uint32_t first() const { return static_cast<std::uint32_t>(lower_[3]); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(upper_[3]); }

  // A hierarchy that may cut marks the pieces of large triangles: their count is the number of the
  // triangle among these, and first() that of the part.
  static constexpr std::uint32_t large_bit = 0x80000000u;
  bool is_large() const { return (count() & large_bit) != 0; }
  std::uint32_t large() const { return count() & ~large_bit; }
  /// Returns how many entries of a leaf it is, whether it is marked or not.
  std::uint32_t weight() const { return is_large() ? 1 : count(); }

 private:
  static Int4 put(Float4 xyz, std::uint32_t number) {
    Int4 bits = std::bit_cast<Int4>(xyz);
    bits[3] = static_cast<int>(number);
    return bits;
  }
  Int4 lower_, upper_;
};

/// Builder asks these questions of pieces of at most `max` triangles.
template <std::uint32_t max>
struct PieceAccess {
  using Primitive = TrianglePiece;
  using Cuts = NoCuts;
  static constexpr std::uint32_t max_weight = max;
  static Bounds bounds_of(const Primitive& p) { return p.bounds(); }
  static std::uint32_t weight_of(const Primitive& p) { return max == 1 ? 1 : p.count(); }
  static std::uint32_t mask_of(const Primitive&) { return 0xFFu; }
  static bool casts_shadow(const Primitive&) { return true; }
  static bool precedes(const Primitive& a, const Primitive& b) { return a.first() < b.first(); }
};

/// Pieces are made of so many triangles at a time, counted from the first one of a hierarchy: no
/// pair crosses the end of such a chunk.
constexpr std::size_t piece_chunk = 1 << 12;

/// Triangles that may be cut are as long as this along an axis of their boxes: half of those that
/// cuts were found to help are over 20 m long, and one in ten is shorter.
constexpr float min_cut_m = 4;

/// Appends the pieces of a chunk of triangles, whose numbers count from `number` on. With `pairs`,
/// two triangles that follow each other are one piece where they share an edge and their common box
/// is no larger than both boxes together. Boxes are those of `frame`, with its margin. `large`:
/// where the corners of triangles that may be cut are appended, in `frame`, and whose pieces are
/// marked so; null = none may.
void append_pieces(std::span<const Corners> chunk, bool pairs, std::uint32_t number,
                   const BoxFrame& frame, std::vector<TrianglePiece>& pieces,
                   LargeVector<PackedCorners>* large = nullptr);

}  // namespace nightcity::hierarchy
