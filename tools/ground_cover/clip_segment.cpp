#include "tools/ground_cover/clip_segment.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace nightcity::ground_cover {

std::optional<std::pair<double, double>> clip_segment(const glm::dvec2& a, const glm::dvec2& b,
                                                      const Box& box) {
  double from = 0, to = 1;
  const glm::dvec2 along = b - a;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0 && (a[axis] < box.low[axis] || a[axis] > box.high[axis]))
      return std::nullopt;
    if (along[axis] == 0) continue;
    const double low = (box.low[axis] - a[axis]) / along[axis],
                 high = (box.high[axis] - a[axis]) / along[axis];
    from = std::max(from, std::min(low, high));
    to = std::min(to, std::max(low, high));
  }
  return from < to ? std::optional(std::pair(from, to)) : std::nullopt;
}

double find_length_m(std::span<const glm::dvec2> line, const Box& box) {
  double length_m = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (const auto part = clip_segment(line[i - 1], line[i], box))
      length_m += glm::distance(line[i - 1], line[i]) * (part->second - part->first);
  return length_m;
}

}  // namespace nightcity::ground_cover
