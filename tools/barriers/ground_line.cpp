#include "tools/barriers/ground_line.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "tools/barriers/obstacles.h"

namespace nightcity::barriers {
namespace {

// On a bank points are added until the ground lies within so much of the edges.
constexpr double max_gap_m = 0.1;

// Adds the points between two at which the ground bends.
void add_bends(const glm::dvec3& from, const glm::dvec3& to, const place::HeightAt& height_at,
               std::vector<glm::dvec3>& points) {
  const double steps = std::ceil(glm::distance(glm::dvec2(from), glm::dvec2(to)) / step_m);
  double worst_m = max_gap_m;
  std::optional<glm::dvec3> bend;
  for (double k = 1; k < steps; ++k) {
    const glm::dvec3 p = glm::mix(from, to, k / steps);
    const auto height = height_at(glm::dvec2(p));
    if (!height || std::abs(*height - p.z) <= worst_m) continue;
    worst_m = std::abs(*height - p.z);
    bend = {p.x, p.y, *height};
  }
  if (!bend) return;
  add_bends(from, *bend, height_at, points);
  points.push_back(*bend);
  add_bends(*bend, to, height_at, points);
}

}  // namespace

std::vector<glm::dvec3> put_on_ground(const std::vector<glm::dvec2>& places,
                                      const place::HeightAt& height_at) {
  std::vector<std::optional<double>> heights;
  for (const glm::dvec2& p : places) heights.push_back(height_at(p));
  std::optional<double> known;
  for (const auto& height : heights)
    if (height && !known) known = height;
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < places.size() && known; ++i) {
    known = heights[i] ? heights[i] : known;
    const glm::dvec3 point(places[i], *known);
    if (!points.empty()) add_bends(glm::dvec3(points.back()), point, height_at, points);
    points.push_back(point);
  }
  return points;
}

}  // namespace nightcity::barriers
