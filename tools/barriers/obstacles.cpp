#include "tools/barriers/obstacles.h"

#include <algorithm>
#include <glm/common.hpp>

namespace nightcity::barriers {

const char* const in_building = "in a building or below a bridge";
const char* const on_carriageway = "on a carriageway";
const char* const beyond_ground = "beyond the ground";
const char* const opening = "open at gates and paths";

const char* Obstacles::find(const glm::dvec2& place) const {
  if (inside_ && inside_(place)) return in_building;
  if (const auto* surface = cover_.surface_at(place); surface && surface->marked)
    return on_carriageway;
  return height_at_(place) ? nullptr : beyond_ground;
}

bool Obstacles::blocks(const glm::dvec2& place) const {
  const char* obstacle = find(place);
  return obstacle == in_building || obstacle == on_carriageway;
}

std::vector<Stretch> Obstacles::find_stretches(const MeasuredWay& line, std::size_t segment,
                                               double from_m, double to_m) const {
  const glm::dvec2 &a = line.points[segment], &b = line.points[segment + 1];
  const double start_m = line.at_m[segment], length_m = line.at_m[segment + 1] - start_m;
  const auto find_at = [&](double s) { return find(glm::mix(a, b, s / length_m)); };
  const std::vector<double> cuts = line.find_cuts(segment, from_m, to_m, step_m);
  constexpr double within_m = 1e-3;  // a node on an outline belongs to what lies beside it
  std::vector<Stretch> found;
  for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
    const double from = cuts[n], to = cuts[n + 1], middle = (from + to) / 2;
    if (line.is_open_at(start_m + middle)) {
      found.push_back({from, to, opening});
      continue;
    }
    const char* first = find_at(std::min(from + within_m, middle));
    const char* last = find_at(std::max(to - within_m, middle));
    double low = from, high = to;
    while (first != last && high - low > within_m)
      (find_at((low + high) / 2) == first ? low : high) = (low + high) / 2;
    const double border = first == last ? to : low;
    if (border > from) found.push_back({from, border, first});
    if (border < to) found.push_back({border, to, last});
  }
  return found;
}

}  // namespace nightcity::barriers
