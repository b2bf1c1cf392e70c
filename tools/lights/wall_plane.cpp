#include "tools/lights/wall_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/in_ring.h"

namespace nightcity::lights {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Returns whether the segment a-b touches the inside of the rectangle (Liang-Barsky clipping).
bool crosses(const dvec2& a, const dvec2& b, const dvec2& low, const dvec2& high) {
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = b[axis] - a[axis];
    if (step == 0) {
      if (a[axis] <= low[axis] || a[axis] >= high[axis]) return false;
      continue;
    }
    double first = (low[axis] - a[axis]) / step, second = (high[axis] - a[axis]) / step;
    if (first > second) std::swap(first, second);
    enter = std::max(enter, first);
    leave = std::min(leave, second);
  }
  return enter < leave;
}

bool crosses(const std::vector<dvec2>& ring, const dvec2& low, const dvec2& high) {
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (crosses(ring[k], ring[(k + 1) % ring.size()], low, high)) return true;
  return false;
}

}  // namespace

dvec2 WallFrame::to_plane(const dvec3& p) const {
  return {glm::dot(p - origin, along), glm::dot(p - origin, up)};
}
dvec3 WallFrame::from_plane(const dvec2& p) const {
  return origin + along * p.x + up * p.y;
}

std::optional<WallFrame> wall_frame(const city::Polygon& polygon) {
  constexpr double max_lean = 0.3;  // |normal.z| of a wall
  const city::Ring& ring = polygon.exterior;
  if (ring.size() < 3) return std::nullopt;
  // Newell's normal, relative to the first vertex because coordinates are large and walls are
  // small.
  dvec3 sum(0);
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    sum += glm::cross(ring[k] - ring[0], ring[k + 1] - ring[0]);
  const double length = glm::length(sum);
  if (!(length > 1e-3) || !std::isfinite(length)) return std::nullopt;
  WallFrame frame;
  frame.origin = ring[0];
  frame.normal = sum / length;
  if (std::abs(frame.normal.z) > max_lean) return std::nullopt;
  frame.along = glm::normalize(dvec3(-frame.normal.y, frame.normal.x, 0));  // cross(up, normal)
  frame.up = glm::cross(frame.normal, frame.along);
  return frame;
}

WallOutline outline_in(const WallFrame& frame, const city::Polygon& polygon) {
  WallOutline outline;
  for (const dvec3& p : polygon.exterior) outline.exterior.push_back(frame.to_plane(p));
  outline.low = outline.high = outline.exterior.front();
  for (const dvec2& p : outline.exterior) {
    outline.low = glm::min(outline.low, p);
    outline.high = glm::max(outline.high, p);
  }
  for (const city::Ring& ring : polygon.interiors) {
    outline.interiors.emplace_back();
    for (const dvec3& p : ring) outline.interiors.back().push_back(frame.to_plane(p));
  }
  return outline;
}

bool contains(const WallOutline& outline, const dvec2& low, const dvec2& high) {
  if (low.x < outline.low.x || low.y < outline.low.y || high.x > outline.high.x ||
      high.y > outline.high.y)
    return false;
  // No edge enters the rectangle, so its middle decides for all of it.
  if (crosses(outline.exterior, low, high)) return false;
  const dvec2 middle = (low + high) * 0.5;
  if (!in_ring(outline.exterior, middle)) return false;
  for (const auto& hole : outline.interiors)
    if (crosses(hole, low, high) || in_ring(hole, middle)) return false;
  return true;
}

}  // namespace nightcity::lights
