#include "tools/ground_cover/box_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "tools/mesh/owner_finder.h"

namespace nightcity::ground_cover {
namespace {

constexpr double finest_m = 32;

double to_squares_a_metre(int level) {
  return std::ldexp(1 / finest_m, -level);
}

std::int64_t to_square(double coordinate, double squares_a_metre) {
  return static_cast<std::int64_t>(std::floor(coordinate * squares_a_metre));
}

std::uint64_t to_key(int level, std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(level) << 58 ^
         static_cast<std::uint64_t>(column & 0x1FFF'FFFF) << 29 ^
         static_cast<std::uint64_t>(row & 0x1FFF'FFFF);
}

constexpr int bits = 29;  // of a column, and of a row, in a key
std::int64_t to_signed(std::uint64_t field) {
  const std::uint64_t low = field & ((std::uint64_t{1} << bits) - 1);
  const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
  return static_cast<std::int64_t>(low ^ sign) - static_cast<std::int64_t>(sign);
}

// Returns whether a segment meets a box: by the separating axes of both.
bool meets(const glm::dvec2& a, const glm::dvec2& b, const Box& box) {
  if (std::max(a.x, b.x) < box.low.x || std::min(a.x, b.x) > box.high.x ||
      std::max(a.y, b.y) < box.low.y || std::min(a.y, b.y) > box.high.y)
    return false;
  const glm::dvec2 middle = (box.low + box.high) / 2.0, half = (box.high - box.low) / 2.0;
  const glm::dvec2 along = b - a, from = middle - a;
  return std::abs(along.x * from.y - along.y * from.x) <=
         std::abs(along.x) * half.y + std::abs(along.y) * half.x;
}

// Passes the key of each square of a level that meets the box.
template <class Visit>
void for_each_square(const Box& box, int level, const Visit& visit) {
  const double scale = to_squares_a_metre(level);
  const std::int64_t right = to_square(box.high.x, scale), top = to_square(box.high.y, scale);
  for (std::int64_t column = to_square(box.low.x, scale); column <= right; ++column)
    for (std::int64_t row = to_square(box.low.y, scale); row <= top; ++row)
      visit(to_key(level, column, row));
}

}  // namespace

Box find_box(const std::vector<std::vector<glm::dvec2>>& rings) {
  Box box{rings.front().front(), rings.front().front()};
  for (const auto& ring : rings)
    for (const glm::dvec2& p : ring) {
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  return box;
}

Share find_share(const std::vector<std::vector<glm::dvec2>>& rings, const Box& box) {
  constexpr double margin_m = 1e-3;  // more than rounding moves an outline
  const Box wider{box.low - margin_m, box.high + margin_m};
  for (const auto& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      if (meets(ring[j], ring[i], wider)) return Share::part;
  return mesh::holds(rings, (box.low + box.high) / 2.0) ? Share::all : Share::none;
}

void BoxIndex::add(std::uint32_t number, const Box& box) {
  const glm::dvec2 extent = box.high - box.low;
  int level = 0;
  while (level + 1 < levels && std::max(extent.x, extent.y) > std::ldexp(finest_m, level)) ++level;
  used_[static_cast<std::size_t>(level)] = true;
  for_each_square(box, level, [&](std::uint64_t square) { squares_[square].push_back(number); });
}

std::vector<std::uint32_t> BoxIndex::find(const Box& box) const {
  std::vector<std::uint32_t> found;
  for (int level = 0; level < levels; ++level)
    if (used_[static_cast<std::size_t>(level)])
      for_each_square(box, level, [&](std::uint64_t square) {
        if (const auto at = squares_.find(square); at != squares_.end())
          found.insert(found.end(), at->second.begin(), at->second.end());
      });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

const std::vector<std::uint32_t>* BoxIndex::find_square(const glm::dvec2& place, int level) const {
  if (!used_[static_cast<std::size_t>(level)]) return nullptr;
  const double scale = to_squares_a_metre(level);
  const auto at =
      squares_.find(to_key(level, to_square(place.x, scale), to_square(place.y, scale)));
  if (at == squares_.end()) return nullptr;
  const auto split = split_.find(at->first);
  if (split == split_.end()) return &at->second;
  Box box = find_box_of_square(at->first);
  std::uint32_t part = split->second;
  while (parts_[part].first_quarter != 0) {
    const glm::dvec2 middle = (box.low + box.high) / 2.0;
    const std::uint32_t quarter = (place.x >= middle.x ? 1 : 0) + (place.y >= middle.y ? 2 : 0);
    box = find_quarter(box, quarter);
    part = parts_[part].first_quarter + quarter;
  }
  return &parts_[part].numbers;
}

Box BoxIndex::find_box_of_square(std::uint64_t key) {
  const double side = std::ldexp(finest_m, static_cast<int>(key >> 58));
  const glm::dvec2 low = side * glm::dvec2(static_cast<double>(to_signed(key >> bits)),
                                           static_cast<double>(to_signed(key)));
  return {low, low + side};
}

Box BoxIndex::find_quarter(const Box& box, std::uint32_t quarter) {
  const glm::dvec2 half = (box.high - box.low) / 2.0;
  const glm::dvec2 low = box.low + half * glm::dvec2(quarter & 1, quarter >> 1);
  return {low, low + half};
}

}  // namespace nightcity::ground_cover
