#include "tools/ground_cover/box_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace nightcity::ground_cover {
namespace {

constexpr double finest_m = 32;

// Passes a number for each square of a level that meets the box.
template <class Visit>
void for_each_square(const Box& box, int level, const Visit& visit) {
  const double squares_a_metre = std::ldexp(1 / finest_m, -level);
  const auto to_square = [&](double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate * squares_a_metre));
  };
  for (std::int64_t column = to_square(box.low.x); column <= to_square(box.high.x); ++column)
    for (std::int64_t row = to_square(box.low.y); row <= to_square(box.high.y); ++row)
      visit(static_cast<std::uint64_t>(level) << 58 ^
            static_cast<std::uint64_t>(column & 0x1FFF'FFFF) << 29 ^
            static_cast<std::uint64_t>(row & 0x1FFF'FFFF));
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
  const std::vector<std::uint32_t>* found = nullptr;
  if (used_[static_cast<std::size_t>(level)])
    for_each_square({place, place}, level, [&](std::uint64_t square) {
      if (const auto at = squares_.find(square); at != squares_.end()) found = &at->second;
    });
  return found;
}

}  // namespace nightcity::ground_cover
