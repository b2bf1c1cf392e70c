#include "tools/lights/wall_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/lights/wall_plane.h"

namespace nightcity {
namespace {

constexpr double cell_m = 16;
constexpr double behind_m = 0.05;
constexpr double most_lean = 0.3;
constexpr double longest_m = 2000;  // a longer wall is a broken coordinate

std::int64_t cell_of(double v) {
  return static_cast<std::int64_t>(std::floor(v / cell_m));
}

std::uint64_t key(std::int64_t x, std::int64_t y) {
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

void WallIndex::add(const CityObject& object) {
  for (const Polygon& polygon : object.polygons) {
    if (polygon.surface != SurfaceType::wall) continue;
    const auto frame = wall_frame(polygon, most_lean);
    if (!frame) continue;
    if (!origin_) origin_ = frame->origin;
    const WallOutline outline = outline_in(*frame, polygon);
    if (!(outline.high.x - outline.low.x < longest_m)) continue;
    const glm::dvec3 a = frame->from_plane({outline.low.x, outline.low.y}) - *origin_;
    const glm::dvec3 b = frame->from_plane({outline.high.x, outline.low.y}) - *origin_;
    const double top = frame->from_plane({0, outline.high.y}).z - origin_->z;
    const auto index = static_cast<std::uint32_t>(walls_.size());
    walls_.push_back({static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                      static_cast<float>(b.y), static_cast<float>(a.z), static_cast<float>(top),
                      static_cast<float>(std::atan2(frame->normal.y, frame->normal.x))});
    // A grid walk would visit fewer cells; walls are short.
    const glm::dvec2 low = glm::min(glm::dvec2(a), glm::dvec2(b)),
                     high = glm::max(glm::dvec2(a), glm::dvec2(b));
    for (std::int64_t x = cell_of(low.x); x <= cell_of(high.x); ++x)
      for (std::int64_t y = cell_of(low.y); y <= cell_of(high.y); ++y) cells_[key(x, y)].push_back(index);
  }
}

bool WallIndex::blocked(const glm::dvec3& p, const glm::dvec3& normal, double reach_m) const {
  if (!origin_) return false;
  const glm::dvec3 local = p - *origin_;
  const glm::dvec2 forward = glm::normalize(glm::dvec2(normal));
  const glm::dvec2 from = glm::dvec2(local) - forward * behind_m, line = forward * (reach_m + behind_m);
  const glm::dvec2 to = from + line;
  const double facing = std::atan2(forward.y, forward.x);
  const glm::dvec2 low = glm::min(from, to), high = glm::max(from, to);
  for (std::int64_t x = cell_of(low.x); x <= cell_of(high.x); ++x)
    for (std::int64_t y = cell_of(low.y); y <= cell_of(high.y); ++y) {
      const auto cell = cells_.find(key(x, y));
      if (cell == cells_.end()) continue;
      for (const std::uint32_t index : cell->second) {
        const Wall& wall = walls_[index];
        if (local.z < wall.low || local.z > wall.high) continue;
        const glm::dvec2 a(wall.ax, wall.ay), edge = glm::dvec2(wall.bx, wall.by) - a;
        const double denominator = cross(line, edge);
        if (std::abs(denominator) < 1e-9) continue;
        const double t = cross(a - from, edge) / denominator, s = cross(a - from, line) / denominator;
        if (t < 0 || t > 1 || s < 0 || s > 1) continue;
        // A wall that faces the same way is the window's own facade, at whatever depth the window is set into
        // it.
        const bool own_facade = std::cos(wall.facing - facing) > 0.99;
        if (!own_facade) return true;
      }
    }
  return false;
}

}  // namespace nightcity
