#include "tools/lights/lamp_aims.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace nightcity::lights {
namespace {

glm::dvec2 rotated(const glm::dvec2& v, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// Returns the direction of a bearing in the frame. A bearing counts from true north and the frame
// has grid north; projecting a point ahead accounts for the difference.
std::optional<glm::dvec2> aim_from_bearing(const glm::dvec2& lon_lat, double degrees,
                                           const place::LonLatToFrame& to_frame) {
  constexpr double step = 1e-4;  // degrees of latitude: 11 m
  const double bearing = glm::radians(degrees);
  const double shrink = std::max(0.01, std::cos(glm::radians(lon_lat.y)));
  const glm::dvec2 ahead(lon_lat.x + step * std::sin(bearing) / shrink,
                         lon_lat.y + step * std::cos(bearing));
  const glm::dvec2 aim = to_frame(ahead) - to_frame(lon_lat);
  const double length = glm::length(aim);
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  return aim / length;
}

}  // namespace

std::vector<glm::dvec2> find_aims(const glm::dvec2& lon_lat, const LampTags& tags,
                                  const glm::dvec3& foot,
                                  const std::optional<RoadIndex::Nearest>& road,
                                  const place::LonLatToFrame& to_frame) {
  std::vector<glm::dvec2> aims;
  for (const double degrees : tags.directions_degrees)
    if (const auto aim = aim_from_bearing(lon_lat, degrees, to_frame)) aims.push_back(*aim);
  if (aims.empty()) {
    glm::dvec2 aim(0, 1);
    if (road) {
      const glm::dvec2 across(-road->along.y, road->along.x);
      const glm::dvec2 towards = road->point - glm::dvec2(foot);
      // A post on the centreline lights across the road.
      aim = road->distance_m > 0.05 ? towards / glm::length(towards) : across;
    }
    aims.push_back(aim);
  }
  const std::size_t directions = aims.size(), wanted = std::max<std::size_t>(
                                                  directions, static_cast<std::size_t>(tags.count));
  for (std::size_t n = directions; n < wanted; ++n)
    aims.push_back(directions > 1
                       ? aims[n % directions]
                       : rotated(aims.front(), 2 * std::numbers::pi * static_cast<double>(n) /
                                                   static_cast<double>(wanted)));
  return aims;
}

}  // namespace nightcity::lights
