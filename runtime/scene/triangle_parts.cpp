#include "runtime/scene/triangle_parts.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "formats/parallel.h"

namespace nightcity::scene {

using hierarchy::Bounds;
using hierarchy::Corners;
using hierarchy::Cut;

namespace {

// The cuts of a hierarchy, each behind the one that made what it cuts: a rank's cuts are of
// triangles or of parts that the ranks before it have made, so that all of them can be made at
// once.
struct Ranks {
  std::vector<std::uint32_t> cuts;  // by their ranks
  std::vector<std::size_t> ends;    // of each rank, among these
};

Ranks rank_cuts(std::span<const Cut> cuts, std::uint32_t triangles) {
  std::vector<std::uint32_t> rank(cuts.size());
  Ranks result;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    if (cuts[k].part >= triangles) rank[k] = 1 + rank[(cuts[k].part - triangles) / 2];
    if (rank[k] >= result.ends.size()) result.ends.push_back(0);
    ++result.ends[rank[k]];
  }
  std::vector<std::size_t> next(result.ends.size());
  for (std::size_t r = 1; r < next.size(); ++r) result.ends[r] += next[r] = result.ends[r - 1];
  result.cuts.resize(cuts.size());
  for (std::size_t k = 0; k < cuts.size(); ++k)
    result.cuts[next[rank[k]]++] = static_cast<std::uint32_t>(k);
  return result;
}

}  // namespace

std::string TriangleParts::measure(std::span<const Cut> cuts, const TriangleList& triangles,
                                   std::size_t first, std::uint32_t count,
                                   const hierarchy::BoxFrame& frame, unsigned threads) {
  end_ = static_cast<std::uint32_t>(first) + count;
  parts_.resize(2 * cuts.size());
  const Ranks ranks = rank_cuts(cuts, count);
  std::atomic<bool> misses = false;
  const auto find_triangle = [&](const Cut& cut) {
    return cut.part < count ? static_cast<std::uint32_t>(first) + cut.part
                            : parts_[cut.part - count].first();
  };
  const auto make = [&](const Cut& cut, std::uint32_t triangle, const Corners& corners,
                        hierarchy::TrianglePiece* to) {
    const Bounds box = cut.part < count ? corners.bounds() : parts_[cut.part - count].bounds();
    const auto halves = hierarchy::cut_box(corners, box, static_cast<int>(cut.axis), cut.plane_m);
    if (!halves) misses = true;
    to[0] = {halves ? halves->first : box, triangle, 1};
    to[1] = {halves ? halves->second : box, triangle, 1};
  };
  constexpr std::size_t piece = 1 << 10;
  std::size_t begin = 0;
  for (const std::size_t end : ranks.ends) {
    run_parallel((end - begin + piece - 1) / piece, threads, [&](std::size_t i) {
      const std::size_t from = begin + i * piece;
      const std::span<const std::uint32_t> some(&ranks.cuts[from], std::min(piece, end - from));
      std::array<std::uint32_t, piece> numbers;
      std::array<Corners, piece> corners;
      for (std::size_t k = 0; k < some.size(); ++k) numbers[k] = find_triangle(cuts[some[k]]);
      triangles.gather(std::span(numbers).first(some.size()), corners);
      for (std::size_t k = 0; k < some.size(); ++k)
        make(cuts[some[k]], numbers[k], frame.turn(corners[k]), &parts_[2 * std::size_t{some[k]}]);
    });
    begin = end;
  }
  return misses ? "a cut misses its part" : "";
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
