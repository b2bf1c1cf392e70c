#include "tools/map_lights/box_around.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "formats/finite.h"

namespace nightcity::map_lights {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Andrew's monotone chain, counter-clockwise.
std::vector<glm::dvec2> find_hull(std::vector<glm::dvec2> points) {
  const auto before = [](const glm::dvec2& a, const glm::dvec2& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<glm::dvec2> hull;
  const auto add = [&hull](const glm::dvec2& p, std::size_t least) {
    while (hull.size() > least && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) add(p, 1);
  const std::size_t upper = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, upper);
  hull.pop_back();
  return hull;
}

Box box_along(const std::vector<glm::dvec2>& hull, glm::dvec2 along) {
  // The same line has one direction, whichever way it was drawn.
  if (along.x < 0 || (along.x == 0 && along.y < 0)) along = -along;
  const glm::dvec2 across(-along.y, along.x), origin = hull.front();
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec2& p : hull) {
    const glm::dvec2 q(glm::dot(p - origin, along), glm::dot(p - origin, across));
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const glm::dvec2 middle = (low + high) * 0.5, size = high - low;
  const glm::dvec2 centre = origin + along * middle.x + across * middle.y;
  return size.x >= size.y ? Box{centre, along, size.x, size.y}
                          : Box{centre, across, size.y, size.x};
}

}  // namespace

std::optional<Box> find_box(std::span<const glm::dvec2> points) {
  if (!std::all_of(points.begin(), points.end(), [](const auto& p) { return finite(p); }))
    return std::nullopt;
  const std::vector<glm::dvec2> hull = find_hull({points.begin(), points.end()});
  if (hull.size() < 2) return std::nullopt;
  std::optional<Box> best;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const glm::dvec2 edge = hull[(k + 1) % hull.size()] - hull[k];
    const double length = glm::length(edge);
    if (!(length > 0)) continue;
    const Box box = box_along(hull, edge / length);
    if (!best || box.length_m * box.width_m < best->length_m * best->width_m) best = box;
  }
  return best;
}

}  // namespace nightcity::map_lights
