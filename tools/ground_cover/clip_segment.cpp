#include "tools/ground_cover/clip_segment.h"

#include <algorithm>
#include <glm/common.hpp>
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

std::vector<Line> clip_line(const Line& line, const Box& box) {
  std::vector<Line> parts;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto within = clip_segment(line[i], line[i + 1], box);
    if (!within || !(within->first < within->second)) {
      goes_on = false;
      continue;
    }
    // Ends that are not cut keep their bits: other lines end there too.
    const auto at = [&](double share) {
      return share <= 0   ? line[i]
             : share >= 1 ? line[i + 1]
                          : glm::mix(line[i], line[i + 1], share);
    };
    if (!goes_on) parts.push_back({at(within->first)});
    parts.back().push_back(at(within->second));
    goes_on = within->second >= 1;
  }
  return parts;
}

}  // namespace nightcity::ground_cover
