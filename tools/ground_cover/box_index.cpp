#include "tools/ground_cover/box_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace nightcity::ground_cover {
namespace {

constexpr double finest_m = 32;

std::int32_t to_square(double coordinate, int level) {
  return static_cast<std::int32_t>(std::floor(coordinate / std::ldexp(finest_m, level)));
}

template <class Visit>
void for_each_square(const Box& box, int level, const Visit& visit) {
  for (std::int32_t column = to_square(box.low.x, level); column <= to_square(box.high.x, level);
       ++column)
    for (std::int32_t row = to_square(box.low.y, level); row <= to_square(box.high.y, level); ++row)
      visit(column, row);
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
  for_each_square(box, level, [&](std::int32_t column, std::int32_t row) {
    squares_[{level, column, row}].push_back(number);
  });
}

std::vector<std::uint32_t> BoxIndex::find(const Box& box) const {
  std::vector<std::uint32_t> found;
  for (int level = 0; level < levels; ++level)
    if (used_[static_cast<std::size_t>(level)])
      for_each_square(box, level, [&](std::int32_t column, std::int32_t row) {
        if (const auto at = squares_.find({level, column, row}); at != squares_.end())
          found.insert(found.end(), at->second.begin(), at->second.end());
      });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace nightcity::ground_cover
