#include "tools/bridges/crossed_ways.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>
#include <utility>

namespace nightcity::bridges {
namespace {

constexpr double longest_m = 1e5;  // a longer jump between two nodes is a broken extract
// Ways that cross at a smaller angle are taken to cross at this one: sine of 17 degrees.
constexpr double min_sine = 0.3;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Returns how far along a, as a share, segment b crosses it.
std::optional<double> intersect(const glm::dvec2& a0, const glm::dvec2& a1, const glm::dvec2& b0,
                                const glm::dvec2& b1) {
  const glm::dvec2 a = a1 - a0, b = b1 - b0;
  const double whole = cross(a, b);
  if (whole == 0) return std::nullopt;
  const double along_a = cross(b0 - a0, b) / whole, along_b = cross(b0 - a0, a) / whole;
  const bool meets = along_a >= 0 && along_a <= 1 && along_b >= 0 && along_b <= 1;
  return meets ? std::optional(along_a) : std::nullopt;
}

ground_cover::Box find_box(const glm::dvec2& a, const glm::dvec2& b) {
  return {glm::min(a, b), glm::max(a, b)};
}

}  // namespace

CrossedWays::CrossedWays(std::span<const PlacedWay> ways) : ways_(ways) {
  for (std::uint32_t w = 0; w < ways.size(); ++w)
    for (std::uint32_t i = 0; i + 1 < ways[w].line.size(); ++i) {
      const glm::dvec2 &a = ways[w].line[i], &b = ways[w].line[i + 1];
      if (glm::distance(a, b) > longest_m) continue;
      index_.add(static_cast<std::uint32_t>(segments_.size()), find_box(a, b));
      segments_.push_back({w, i});
    }
}

std::vector<Crossing> CrossedWays::find(const Chain& chain) const {
  const std::set<NodeKey> nodes(chain.nodes.begin(), chain.nodes.end());
  std::vector<Crossing> found;
  double at_m = 0;
  for (std::size_t i = 0; i + 1 < chain.line.size(); ++i) {
    const glm::dvec2 &a = chain.line[i], &b = chain.line[i + 1];
    const double length_m = glm::distance(a, b);
    for (const std::uint32_t number : index_.find(find_box(a, b))) {
      const PlacedWay& way = ways_[segments_[number].way];
      const std::size_t first = segments_[number].first;
      const auto share = intersect(a, b, way.line[first], way.line[first + 1]);
      if (!share || nodes.contains(to_key(way.lon_lat[first])) ||
          nodes.contains(to_key(way.lon_lat[first + 1])))
        continue;
      const glm::dvec2 u = (b - a) / length_m,
                       v = glm::normalize(way.line[first + 1] - way.line[first]);
      const double sine = std::max(std::abs(cross(u, v)), min_sine);
      const double half_m = (way.half_m + chain.half_m * std::abs(glm::dot(u, v))) / sine;
      found.push_back(
          {segments_[number].way, first, at_m + *share * length_m, half_m, a + (b - a) * *share});
    }
    at_m += length_m;
  }
  std::sort(found.begin(), found.end(), [](const Crossing& x, const Crossing& y) {
    return std::tie(x.at_m, x.way) < std::tie(y.at_m, y.way);
  });
  return found;
}

}  // namespace nightcity::bridges
