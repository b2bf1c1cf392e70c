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
constexpr double looked_through_m = 30;
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

void WallIndex::add(const CityObject& object, std::uint32_t owner) {
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
                      static_cast<float>(std::atan2(frame->normal.y, frame->normal.x)), owner});
    // A grid walk would visit fewer cells; walls are short.
    const glm::dvec2 low = glm::min(glm::dvec2(a), glm::dvec2(b)),
                     high = glm::max(glm::dvec2(a), glm::dvec2(b));
    for (std::int64_t x = cell_of(low.x); x <= cell_of(high.x); ++x)
      for (std::int64_t y = cell_of(low.y); y <= cell_of(high.y); ++y) cells_[key(x, y)].push_back(index);
  }
}

template <class Visit>
void WallIndex::crossings(const glm::dvec3& local, const glm::dvec2& from, const glm::dvec2& line,
                          const Visit& visit) const {
  const glm::dvec2 to = from + line;
  const double direction = std::atan2(line.y, line.x);
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
        if (t >= 0 && t <= 1 && s >= 0 && s <= 1) visit(wall, t, std::cos(wall.facing - direction));
      }
    }
}

bool WallIndex::blocked(const glm::dvec3& p, const glm::dvec3& normal, double reach_m,
                        std::uint32_t owner) const {
  if (!origin_) return false;
  const glm::dvec3 local = p - *origin_;
  const glm::dvec2 forward = glm::normalize(glm::dvec2(normal));
  bool found = false;
  crossings(local, glm::dvec2(local) - forward * behind_m, forward * (reach_m + behind_m),
            [&](const Wall& wall, double t, double same_way) {
              const bool ahead = t * (reach_m + behind_m) > 2 * behind_m;
              // The own facade, at whatever depth the window is set into it; of another building only what
              // stands clearly before the window, for facades of a row lie in one plane.
              const bool facade = same_way > 0.99 && (wall.owner == owner || !ahead);
              found |= !facade;
            });
  return found;
}

bool WallIndex::inside_another(const glm::dvec3& p, const glm::dvec3& normal, std::uint32_t owner) const {
  if (!origin_) return false;
  const glm::dvec3 local = p - *origin_;
  const glm::dvec2 forward = glm::normalize(glm::dvec2(normal)) * looked_through_m;
  double nearest = 2;
  std::optional<std::uint32_t> around;
  crossings(local, glm::dvec2(local), forward, [&](const Wall& wall, double t, double same_way) {
    if (wall.owner == owner || t * looked_through_m < 2 * behind_m || t >= nearest) return;
    nearest = t;
    around = same_way > 0 ? std::optional(wall.owner) : std::nullopt;
  });
  if (!around) return false;
  bool behind_too = false;
  crossings(local, glm::dvec2(local), -forward, [&](const Wall& wall, double, double same_way) {
    behind_too |= wall.owner == *around && same_way > 0;
  });
  return behind_too;
}

}  // namespace nightcity
