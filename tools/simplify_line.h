// Leaves out points of a line that lie on it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "tools/line.h"

namespace nightcity {

/// Returns the line without points that lie within `tolerance_m` of it (Douglas and Peucker 1973).
/// Its ends stay, and every thousandth point, so that time grows with the number of points alone.
inline Line simplify_line(const Line& line, double tolerance_m) {
  constexpr std::size_t max_run = 1000;
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size());
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t i = 0; i + 1 < line.size(); i += max_run)
    runs.emplace_back(i, std::min(i + max_run, line.size() - 1));
  while (!runs.empty()) {
    const auto [first, last] = runs.back();
    runs.pop_back();
    kept[first] = kept[last] = true;
    double worst_m = tolerance_m;
    std::size_t worst = first;
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double d = find_distance(line[i], line[first], line[last]); d > worst_m) {
        worst_m = d;
        worst = i;
      }
    if (worst == first) continue;
    runs.emplace_back(first, worst);
    runs.emplace_back(worst, last);
  }
  Line simple;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) simple.push_back(line[i]);
  return simple;
}

}  // namespace nightcity
