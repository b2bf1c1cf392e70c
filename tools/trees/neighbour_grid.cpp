#include "tools/trees/neighbour_grid.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace nightcity::trees {

NeighbourGrid::Square NeighbourGrid::find_square(const glm::dvec2& place) const {
  return {static_cast<std::int64_t>(std::floor(place.x / distance_m_)),
          static_cast<std::int64_t>(std::floor(place.y / distance_m_))};
}

bool NeighbourGrid::has_neighbour(const glm::dvec2& place) const {
  const auto [i, j] = find_square(place);
  for (std::int64_t column = i - 1; column <= i + 1; ++column)
    for (std::int64_t row = j - 1; row <= j + 1; ++row)
      if (const auto found = squares_.find({column, row}); found != squares_.end())
        for (const glm::dvec2& p : found->second)
          if (glm::distance(p, place) < distance_m_) return true;
  return false;
}

}  // namespace nightcity::trees
