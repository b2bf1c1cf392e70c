// A line in the plane.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace nightcity {

using Line = std::vector<glm::dvec2>;

/// Returns whether `a` comes before `b`: an order that depends on coordinates alone.
inline bool comes_before(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}
inline bool comes_before(const Line& a, const Line& b) {
  return std::lexicographical_compare(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const glm::dvec2& p, const glm::dvec2& q) { return comes_before(p, q); });
}

/// Returns whether the line turned round would come before it.
inline bool runs_back(const Line& line) {
  return std::lexicographical_compare(
      line.rbegin(), line.rend(), line.begin(), line.end(),
      [](const glm::dvec2& p, const glm::dvec2& q) { return comes_before(p, q); });
}
/// Returns whether `a` comes before `b` if the directions of lines do not matter.
inline bool comes_before_either_way(const Line& a, const Line& b) {
  const auto order = [](const glm::dvec2& p, const glm::dvec2& q) { return comes_before(p, q); };
  const auto compare = [&](auto first, auto last) {
    return runs_back(b) ? std::lexicographical_compare(first, last, b.rbegin(), b.rend(), order)
                        : std::lexicographical_compare(first, last, b.begin(), b.end(), order);
  };
  return runs_back(a) ? compare(a.rbegin(), a.rend()) : compare(a.begin(), a.end());
}

struct PointOrder {
  bool operator()(const glm::dvec2& a, const glm::dvec2& b) const { return comes_before(a, b); }
};

/// Returns the distance of `p` from the straight line between `a` and `b`, both ends among it.
inline double find_distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double share = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + share * along);
}

}  // namespace nightcity
