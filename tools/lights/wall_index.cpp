#include "tools/lights/wall_index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "tools/lights/wall_crowds.h"
#include "tools/lights/wall_plane.h"

namespace nightcity::lights {
namespace {

constexpr double bucket_m = 16;
constexpr std::int32_t buckets = 8;          // along each side of a cell
constexpr std::size_t max_cached = 800'000;  // walls, 36 bytes each
constexpr std::size_t crowded = 1024;        // walls of a bucket
constexpr double near_equal_per_m = 100;     // of walls in a crowded bucket
constexpr double behind_m = 0.05;
constexpr double looked_through_m = 30;
constexpr double longest_wall_m = 2000;  // a longer wall is a broken coordinate

// Clamped, so that a wrong coordinate does not overflow.
std::int32_t bucket_of(double v) {
  return static_cast<std::int32_t>(std::floor(std::clamp(v / bucket_m, -1e9, 1e9)));
}

std::int32_t cell_of(std::int32_t bucket) {
  return bucket >= 0 ? bucket / buckets : -((buckets - 1 - bucket) / buckets);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

// The walls of a cell, by bucket.
struct WallIndex::Loaded {
  std::vector<Wall> walls;  // as WallCrowds keeps them: what blocked() asks, the others say too
  std::vector<std::uint32_t> first, inside;
  WallCrowds crowds;

  Loaded(const std::vector<Wall>& read, const CellKey& key) {
    keep(read, key, [](float v) { return std::bit_cast<std::uint32_t>(v); });
    if (find_fullest() <= crowded) return;
    // A look at each of thousands of walls that are all but the same would have no end either.
    keep(read, key, [](float v) {
      return static_cast<std::uint32_t>(
          static_cast<std::int64_t>(std::floor(static_cast<double>(v) * near_equal_per_m)));
    });
  }

  // Walls whose numbers are alike count as walls in one place.
  template <class ToNumber>
  void keep(const std::vector<Wall>& read, const CellKey& key, const ToNumber& number) {
    std::vector<WallPlace> places;
    std::vector<std::uint32_t> owners;
    places.reserve(read.size());
    owners.reserve(read.size());
    for (const Wall& wall : read) {
      places.push_back({number(wall.ax), number(wall.ay), number(wall.bx), number(wall.by),
                        number(wall.low), number(wall.high), number(wall.east),
                        number(wall.north)});
      owners.push_back(wall.owner);
    }
    crowds = find_crowds(places, owners);
    walls.clear();
    walls.reserve(crowds.kept.size());
    for (const WallCrowds::Kept& kept : crowds.kept) walls.push_back(read[kept.wall]);
    sort_into_buckets(key);
  }

  void sort_into_buckets(const CellKey& key) {
    first.assign(std::size_t{buckets} * buckets + 1, 0);
    for (const Wall& wall : walls) visit(wall, key, [&](std::size_t b) { ++first[b + 1]; });
    for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
    inside.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < walls.size(); ++i)
      visit(walls[i], key, [&](std::size_t b) { inside[next[b]++] = i; });
  }

  std::size_t find_fullest() const {
    std::size_t most = 0;
    for (std::size_t b = 0; b + 1 < first.size(); ++b)
      most = std::max<std::size_t>(most, first[b + 1] - first[b]);
    return most;
  }

  /// Memory used, in walls.
  std::size_t cost() const { return walls.size() + (inside.size() + crowds.size()) / 8 + 16; }

  /// Returns whether the owner has a wall where that one of `walls` stands.
  bool stands_at(std::size_t wall, std::uint32_t owner) const {
    const std::uint32_t crowd = crowds.kept[wall].crowd;
    return crowd == no_crowd ? walls[wall].owner == owner : crowds.holds(crowd, owner);
  }

  // A grid traversal would visit fewer buckets, but walls are short.
  template <class Visit>
  static void visit(const Wall& wall, const CellKey& key, const Visit& each) {
    const auto range = [](float a, float b, std::int32_t cell) {
      const std::int32_t begin = cell * buckets;
      return std::pair(std::max(bucket_of(std::min(a, b)), begin) - begin,
                       std::min(bucket_of(std::max(a, b)), begin + buckets - 1) - begin);
    };
    const auto [left, right] = range(wall.ax, wall.bx, key.column);
    const auto [low, high] = range(wall.ay, wall.by, key.row);
    for (std::int32_t y = low; y <= high; ++y)
      for (std::int32_t x = left; x <= right; ++x) each(static_cast<std::size_t>(y * buckets + x));
  }
};

WallIndex::WallIndex(const std::filesystem::path& scratch)
    : cells_(scratch), cache_(std::make_unique<CellCache<CellKey, Loaded>>(max_cached)) {}
WallIndex::~WallIndex() = default;
WallIndex::WallIndex(WallIndex&&) noexcept = default;

std::vector<WallIndex::UprightWall> WallIndex::find_upright_walls(const city::CityObject& object) {
  std::vector<UprightWall> walls;
  for (const city::Polygon& polygon : object.polygons) {
    if (polygon.surface != city::SurfaceType::wall) continue;
    const auto frame = wall_frame(polygon);
    if (!frame) continue;
    const WallOutline outline = outline_in(*frame, polygon);
    if (!(outline.high.x - outline.low.x < longest_wall_m)) continue;
    const glm::dvec3 a = frame->from_plane({outline.low.x, outline.low.y});
    const glm::dvec3 b = frame->from_plane({outline.high.x, outline.low.y});
    const double top = frame->from_plane({0, outline.high.y}).z;
    walls.push_back({glm::dvec2(a), glm::dvec2(b), a.z, top, glm::dvec2(frame->normal)});
  }
  return walls;
}

void WallIndex::add(std::span<const UprightWall> walls, std::uint32_t owner) {
  for (const UprightWall& upright : walls) {
    if (!origin_) origin_ = glm::dvec3(upright.from, upright.low);
    const glm::dvec2 a = upright.from - glm::dvec2(*origin_), b = upright.to - glm::dvec2(*origin_);
    const glm::dvec2 normal = glm::normalize(upright.normal);
    const Wall wall{static_cast<float>(a.x),
                    static_cast<float>(a.y),
                    static_cast<float>(b.x),
                    static_cast<float>(b.y),
                    static_cast<float>(upright.low - origin_->z),
                    static_cast<float>(upright.high - origin_->z),
                    static_cast<float>(normal.x),
                    static_cast<float>(normal.y),
                    owner};
    const auto cell = [](float v) { return cell_of(bucket_of(static_cast<double>(v))); };
    for (std::int32_t x = cell(std::min(wall.ax, wall.bx)); x <= cell(std::max(wall.ax, wall.bx));
         ++x)
      for (std::int32_t y = cell(std::min(wall.ay, wall.by)); y <= cell(std::max(wall.ay, wall.by));
           ++y)
        cells_.add({x, y}, wall);
  }
}

std::pair<std::int32_t, std::int32_t> WallIndex::find_cell(const glm::dvec3& p) const {
  const glm::dvec2 local = glm::dvec2(p - origin_.value_or(glm::dvec3(0)));
  return {cell_of(bucket_of(local.x)), cell_of(bucket_of(local.y))};
}

// A horizontal line.
struct WallIndex::Line {
  double height = 0;
  glm::dvec2 from{0}, step{0};

  // Returns the place in [0, 1] along the line where a wall crosses it; none where none does.
  std::optional<double> find_crossing(const Wall& wall) const {
    if (height < wall.low || height > wall.high) return {};
    const glm::dvec2 a(wall.ax, wall.ay), edge = glm::dvec2(wall.bx, wall.by) - a;
    const double denominator = cross(step, edge);
    if (std::abs(denominator) < 1e-9) return {};
    const double s = cross(a - from, step) / denominator;
    if (!(s >= 0 && s <= 1)) return {};
    const double t = cross(a - from, edge) / denominator;
    return t >= 0 && t <= 1 ? std::optional(t) : std::nullopt;
  }
};

template <class Visit>
bool WallIndex::any_in_buckets(const glm::dvec2& low, const glm::dvec2& high, const Visit& visit) {
  std::optional<CellKey> last;  // buckets side by side are mostly of one cell
  std::shared_ptr<const Loaded> cell;
  const std::int32_t right = bucket_of(high.x), top = bucket_of(high.y);
  for (std::int32_t x = bucket_of(low.x); x <= right; ++x)
    for (std::int32_t y = bucket_of(low.y); y <= top; ++y) {
      const CellKey key{cell_of(x), cell_of(y)};
      if (last != key) cell = cache_->get(key, [&] { return Loaded(cells_.read(key), key); });
      last = key;
      const auto b =
          static_cast<std::size_t>((y - key.row * buckets) * buckets + x - key.column * buckets);
      for (std::uint32_t i = cell->first[b]; i < cell->first[b + 1]; ++i)
        if (visit(*cell, cell->inside[i])) return true;
    }
  return false;
}

template <class Visit>
bool WallIndex::any_crossing(double height, const glm::dvec2& from, const glm::dvec2& step,
                             const Visit& visit) {
  const glm::dvec2 to = from + step, direction = glm::normalize(step);
  const Line line{height, from, step};
  return any_in_buckets(
      glm::min(from, to), glm::max(from, to), [&](const Loaded& cell, std::size_t n) {
        const Wall& wall = cell.walls[n];
        const auto t = line.find_crossing(wall);
        return t && visit(cell, n, *t, glm::dot(glm::dvec2(wall.east, wall.north), direction));
      });
}

bool WallIndex::blocked(std::span<const glm::dvec3> points, const glm::dvec3& normal,
                        double reach_m, std::uint32_t owner) {
  if (!origin_ || points.empty()) return false;
  const glm::dvec2 forward = glm::normalize(glm::dvec2(normal));
  const glm::dvec2 step = forward * (reach_m + behind_m), direction = glm::normalize(step);
  std::vector<Line> lines;
  lines.reserve(points.size());
  for (const glm::dvec3& p : points) {
    const glm::dvec3 local = p - *origin_;
    lines.push_back({local.z, glm::dvec2(local) - forward * behind_m, step});
  }
  glm::dvec2 low = lines.front().from, high = low;
  for (const Line& line : lines) {
    low = glm::min(low, glm::min(line.from, line.from + step));
    high = glm::max(high, glm::max(line.from, line.from + step));
  }
  // The window's own facade does not block it, at whatever depth the window lies in it. Of another
  // building only what stands clearly in front of the window counts, because the facades of a row
  // lie in one plane.
  const auto blocks = [&](const Wall& wall, double t) {
    const bool ahead = t * (reach_m + behind_m) > 2 * behind_m;
    const double same_way = glm::dot(glm::dvec2(wall.east, wall.north), direction);
    const bool facade = same_way > 0.99 && (wall.owner == owner || !ahead);
    return !facade;
  };
  // Most walls of a bucket are far from all of the lines; those within rounding are not.
  constexpr double rounding_m = 0.01;
  const glm::vec2 least(low - rounding_m), most(high + rounding_m);
  return any_in_buckets(low, high, [&](const Loaded& cell, std::size_t n) {
    const Wall& wall = cell.walls[n];
    if (std::max(wall.ax, wall.bx) < least.x || std::min(wall.ax, wall.bx) > most.x ||
        std::max(wall.ay, wall.by) < least.y || std::min(wall.ay, wall.by) > most.y)
      return false;
    return std::any_of(lines.begin(), lines.end(), [&](const Line& line) {
      const auto t = line.find_crossing(wall);
      return t && blocks(wall, *t);
    });
  });
}

bool WallIndex::inside_another(const glm::dvec3& p, const glm::dvec3& normal, std::uint32_t owner) {
  if (!origin_) return false;
  const glm::dvec3 local = p - *origin_;
  const glm::dvec2 forward = glm::normalize(glm::dvec2(normal)) * looked_through_m;
  double nearest = 2;
  std::optional<std::uint32_t> around;
  const auto find_nearest = [&](const Loaded& cell, std::size_t n, double t, double same_way) {
    const Wall& wall = cell.walls[n];
    if (wall.owner == owner || t * looked_through_m < 2 * behind_m || t >= nearest) return false;
    nearest = t;
    around = same_way > 0 ? std::optional(wall.owner) : std::nullopt;
    return false;
  };
  any_crossing(local.z, glm::dvec2(local), forward, find_nearest);
  if (!around) return false;
  const auto is_back = [&](const Loaded& cell, std::size_t n, double, double same_way) {
    return same_way > 0 && cell.stands_at(n, *around);
  };
  return any_crossing(local.z, glm::dvec2(local), -forward, is_back);
}

}  // namespace nightcity::lights
