// The mean of places on the globe.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/place/longitude.h"

namespace nightcity::osm {

/// Returns the mean of places in degrees, of which a last one that repeats the first counts once.
/// There is one at least.
inline glm::dvec2 find_mean_place(const std::vector<glm::dvec2>& points) {
  const bool closed = points.size() > 1 && points.front() == points.back();
  const std::size_t count = points.size() - (closed ? 1 : 0);
  glm::dvec2 sum(0);
  for (std::size_t n = 0; n < count; ++n)
    sum += glm::dvec2(place::count_on(points[n].x, points[0].x), points[n].y);
  sum /= static_cast<double>(count);
  return {place::count_on(sum.x, 0), sum.y};
}

}  // namespace nightcity::osm
