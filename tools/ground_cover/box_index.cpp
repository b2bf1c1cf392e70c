#include "tools/ground_cover/box_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

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
  return at == squares_.end() ? nullptr : &at->second;
}

}  // namespace nightcity::ground_cover
