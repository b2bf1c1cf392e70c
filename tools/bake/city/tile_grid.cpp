#include "tools/bake/city/tile_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace nightcity::bake {

void ObjectTiles::add(const glm::dvec3 (&corners)[3]) {
  for (const glm::dvec3& corner : corners) {
    min_ = glm::min(min_, glm::dvec2(corner));
    max_ = glm::max(max_, glm::dvec2(corner));
  }
}

Tile ObjectTiles::find_tile(const glm::dvec3 (&corners)[3]) const {
  const glm::dvec2 extent = max_ - min_;
  const bool whole = std::max(extent.x, extent.y) <= size_m_;
  const glm::dvec2 centre =
      whole ? (min_ + max_) / 2.0 : glm::dvec2((corners[0] + corners[1] + corners[2]) / 3.0);
  return {static_cast<std::int32_t>(std::floor(centre.x / size_m_)),
          static_cast<std::int32_t>(std::floor(centre.y / size_m_))};
}

}  // namespace nightcity::bake
