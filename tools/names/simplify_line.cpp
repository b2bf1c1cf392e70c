#include "tools/names/simplify_line.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

namespace nightcity::names {
namespace {

double find_distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double share = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + share * along);
}

}  // namespace

Line simplify_line(const Line& line, double tolerance_m) {
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

}  // namespace nightcity::names
