#include "tools/terrain/surface_store.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace nightcity::terrain {
namespace {

constexpr double finest_cell_m = 128;
constexpr std::size_t max_cached = 320'000;  // triangles, 80 bytes each
// Triangles of a bucket: so few are all looked at, and so many are boxed.
constexpr std::size_t few = 32, crowded = 256;
constexpr std::size_t block_size = 64;     // triangles that share a box where one is crowded
constexpr double min_plan_area_m2 = 1e-8;  // below it a triangle is a wall or a line
constexpr double edge_m = 1e-6;            // a point this near to an edge counts as on it
constexpr double beyond_any_frame_m = 1e9;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

// A cell's triangles with a grid of their own, about two per bucket; from the highest on where a
// bucket has more than a few.
struct SurfaceStore::Loaded {
  std::vector<Triangle> triangles;
  std::vector<double> tops;  // no triangle is higher anywhere; empty where they are not sorted
  glm::dvec2 corner{0};
  double buckets_per_m = 1;
  int side = 1;
  std::vector<std::uint32_t> first, inside;
  std::vector<Extent> boxes;  // of each block_size of `inside`; empty where no bucket is crowded

  Loaded(std::vector<Triangle> t, const glm::dvec2& low, double size)
      : triangles(std::move(t)), corner(low) {
    choose_buckets(size);
    sort_into_buckets();
    if (find_fullest() <= few) return;
    if (find_fullest() > crowded) {
      remove_repeats();
      choose_buckets(size);
    }
    sort_from_the_top();
    sort_into_buckets();
    if (find_fullest() > crowded) box_blocks();
  }

  // Thousands of triangles that each cover the whole cell would be listed in all of its buckets.
  void choose_buckets(double size) {
    constexpr std::size_t places_a_triangle = 16;
    side =
        std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles.size()) / 2)), 1, 256);
    for (;; side /= 2) {
      buckets_per_m = side / size;
      std::size_t places = 0;
      for (const Triangle& triangle : triangles) places += find_buckets(triangle).count();
      if (side == 1 || places <= places_a_triangle * triangles.size()) return;
    }
  }

  void sort_into_buckets() {
    first.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) + 1, 0);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      visit(triangles[i], [&](std::size_t b) { ++first[b + 1]; });
    for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
    inside.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      visit(triangles[i], [&](std::size_t b) { inside[next[b]++] = i; });
  }

  std::size_t find_fullest() const {
    std::size_t most = 0;
    for (std::size_t b = 0; b + 1 < first.size(); ++b)
      most = std::max<std::size_t>(most, first[b + 1] - first[b]);
    return most;
  }

  // Each place would be looked for in all copies of an object that was exported thousands of times,
  // and each of them gives the same height.
  void remove_repeats() {
    const auto key = [](const Triangle& triangle) {
      return std::bit_cast<std::array<std::uint64_t, 9>>(triangle);
    };
    std::sort(triangles.begin(), triangles.end(),
              [&](const Triangle& a, const Triangle& b) { return key(a) < key(b); });
    triangles.erase(
        std::unique(triangles.begin(), triangles.end(),
                    [&](const Triangle& a, const Triangle& b) { return key(a) == key(b); }),
        triangles.end());
  }

  // A triangle serves places within edge_m of it, where its plane may rise above its corners.
  static double find_top(const Triangle& t) {
    const auto [low, high] = std::minmax({t.corners[0].z, t.corners[1].z, t.corners[2].z});
    if (!(low < high)) return high;
    const glm::dvec2 u(t.corners[1] - t.corners[0]), v(t.corners[2] - t.corners[0]);
    const double around = glm::length(u) + glm::length(v) + glm::length(v - u),
                 beyond = 2 * edge_m * around / std::abs(cross(u, v)) + 1e-6;
    return high + beyond * (high - low) + 1e-9 * std::max(std::abs(low), std::abs(high));
  }

  void sort_from_the_top() {
    std::vector<std::pair<double, std::uint32_t>> order;
    order.reserve(triangles.size());
    for (const Triangle& triangle : triangles)
      order.emplace_back(-find_top(triangle), static_cast<std::uint32_t>(order.size()));
    std::sort(order.begin(), order.end());
    std::vector<Triangle> sorted;
    sorted.reserve(order.size());
    tops.reserve(order.size());
    for (const auto& [depth, number] : order) {
      sorted.push_back(triangles[number]);
      tops.push_back(-depth);
    }
    triangles = std::move(sorted);
  }

  // Returns the rectangle of all places that the triangle serves, which reach the farther beyond a
  // corner the sharper it is.
  static Extent find_served(const Triangle& t) {
    const glm::dvec2 a(t.corners[0]), u = glm::dvec2(t.corners[1]) - a,
                                      v = glm::dvec2(t.corners[2]) - a;
    const glm::dvec2 low = glm::min(a, a + glm::min(u, v)), high = glm::max(a, a + glm::max(u, v));
    const double around = glm::length(u) + glm::length(v) + glm::length(v - u),
                 beyond = 2 * edge_m * around / std::abs(cross(u, v));
    const glm::dvec2 margin = beyond * (high - low) + edge_m;
    return {low - margin, high + margin};
  }

  // Thousands of triangles that differ by less than a millimetre serve nearly the same places, and
  // most places that are asked for are beside them.
  void box_blocks() {
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const Extent served = find_served(triangles[inside[i]]);
      if (i % block_size == 0) boxes.push_back(served);
      boxes.back().low = glm::min(boxes.back().low, served.low);
      boxes.back().high = glm::max(boxes.back().high, served.high);
    }
  }

  bool may_serve(std::size_t block, const glm::dvec2& p) const {
    const Extent& box = boxes[block];
    return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
  }

  /// Memory, in triangles.
  std::size_t cost() const { return triangles.size() + inside.size() / 20 + 8; }

  int index(double along) const {
    return static_cast<int>(std::clamp(along * buckets_per_m, 0.0, static_cast<double>(side - 1)));
  }
  std::size_t bucket_at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(column);
  }
  struct Buckets {
    int left, right, bottom, top;
    std::size_t count() const {
      return static_cast<std::size_t>(right - left + 1) *
             static_cast<std::size_t>(top - bottom + 1);
    }
  };
  Buckets find_buckets(const Triangle& t) const {
    const glm::dvec2 a(t.corners[0]), b(t.corners[1]), c(t.corners[2]);
    const glm::dvec2 low = glm::min(glm::min(a, b), c) - corner - edge_m,
                     high = glm::max(glm::max(a, b), c) - corner + edge_m;
    return {index(low.x), index(high.x), index(low.y), index(high.y)};
  }
  template <class Visitor>
  void visit(const Triangle& t, const Visitor& visitor) const {
    const Buckets buckets = find_buckets(t);
    for (int row = buckets.bottom; row <= buckets.top; ++row)
      for (int column = buckets.left; column <= buckets.right; ++column)
        visitor(bucket_at(column, row));
  }

  static std::optional<double> height(const Triangle& t, const glm::dvec2& p) {
    const glm::dvec2 a(t.corners[0]), u = glm::dvec2(t.corners[1]) - a,
                                      v = glm::dvec2(t.corners[2]) - a, w = v - u, q = p - a;
    const double twice = cross(u, v), side = twice > 0 ? 1 : -1;
    // Lengths are found for points beside the edge alone.
    const auto is_outside = [&](double area, const glm::dvec2& edge) {
      return side * area < 0 && side * area < -edge_m * glm::length(edge);
    };
    if (is_outside(cross(u, q), u) || is_outside(cross(q, v), v) || is_outside(cross(w, q - u), w))
      return std::nullopt;
    const double s = cross(q, v) / twice, r = cross(u, q) / twice, z = t.corners[0].z;
    return z + s * (t.corners[1].z - z) + r * (t.corners[2].z - z);
  }

  // Returns at how many triangles it looked.
  std::size_t raise(const glm::dvec2& p, std::optional<double>& best) const {
    const std::size_t b = bucket_at(index(p.x - corner.x), index(p.y - corner.y));
    std::size_t count = 0, boxed = 0;  // places of `inside` whose blocks have been asked
    const auto is_below = [&](std::uint32_t triangle) {
      return !tops.empty() && best && *best >= tops[triangle];
    };
    for (std::size_t i = first[b]; i < first[b + 1] && !is_below(inside[i]); ++i) {
      if (!boxes.empty() && i >= boxed) {
        boxed = (i | (block_size - 1)) + 1;
        if (!may_serve(i / block_size, p)) {
          i = boxed - 1;
          continue;
        }
      }
      ++count;
      if (const auto z = height(triangles[inside[i]], p); z && (!best || *z > *best)) best = z;
    }
    return count;
  }
};

SurfaceStore::SurfaceStore(const std::filesystem::path& path)
    : cells_(path), cache_(std::make_unique<CellCache<CellKey, Loaded>>(max_cached)) {}
SurfaceStore::~SurfaceStore() = default;

double SurfaceStore::cell_size(int level) {
  return std::ldexp(finest_cell_m, level);
}

bool SurfaceStore::add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double plan = std::abs(cross(glm::dvec2(b - a), glm::dvec2(c - a))) / 2;
  // These comparisons are false for NaN too.
  if (!(plan > min_plan_area_m2) ||
      !(std::abs(a.z) + std::abs(b.z) + std::abs(c.z) < beyond_any_frame_m))
    return false;
  if (!origin_) origin_ = glm::floor(glm::dvec2(a));
  const glm::dvec3 shift(*origin_, 0);
  const Triangle triangle{{a - shift, b - shift, c - shift}};
  const glm::dvec2 p(triangle.corners[0]), q(triangle.corners[1]), r(triangle.corners[2]);
  const glm::dvec2 low = glm::min(glm::min(p, q), r) - edge_m,
                   high = glm::max(glm::max(p, q), r) + edge_m;
  const double extent = std::max(high.x - low.x, high.y - low.y);
  int level = 0;
  while (level + 1 < levels && cell_size(level) < extent) ++level;
  const double size = cell_size(level);
  if (!(std::max(glm::length(low), glm::length(high)) / size < 1e9)) return false;  // in no frame
  used_[static_cast<std::size_t>(level)] = true;
  ++count_;
  cache_->clear();
  if (!extent_) extent_ = Extent{glm::dvec2(a), glm::dvec2(a)};
  for (const glm::dvec3* corner : {&a, &b, &c}) {
    extent_->low = glm::min(extent_->low, glm::dvec2(*corner));
    extent_->high = glm::max(extent_->high, glm::dvec2(*corner));
  }
  const auto cell = [size](double v) { return static_cast<std::int32_t>(std::floor(v / size)); };
  for (std::int32_t column = cell(low.x); column <= cell(high.x); ++column)
    for (std::int32_t row = cell(low.y); row <= cell(high.y); ++row)
      cells_.add({level, column, row}, triangle);
  return true;
}

template <class Visit>
void SurfaceStore::for_each_cell(const glm::dvec2& p, const Visit& visit) {
  if (!origin_ || !std::isfinite(p.x + p.y)) return;
  const glm::dvec2 local = p - *origin_;
  for (int level = 0; level < levels; ++level) {
    if (!used_[static_cast<std::size_t>(level)]) continue;
    const double size = cell_size(level);
    const glm::dvec2 place = glm::floor(local / size);
    if (!(std::abs(place.x) < 1e9 && std::abs(place.y) < 1e9)) continue;
    const CellKey key{level, static_cast<std::int32_t>(place.x),
                      static_cast<std::int32_t>(place.y)};
    const auto loaded = cache_->get(key, [&] {
      return Loaded(cells_.read(key), glm::dvec2(key.column, key.row) * size, size);
    });
    visit(*loaded, local);
  }
}

std::optional<double> SurfaceStore::highest_at(const glm::dvec2& p) {
  std::optional<double> best;
  for_each_cell(p, [&](const Loaded& cell, const glm::dvec2& local) { cell.raise(local, best); });
  return best;
}

std::size_t SurfaceStore::count_candidates(const glm::dvec2& p) {
  std::size_t count = 0;
  std::optional<double> best;
  for_each_cell(
      p, [&](const Loaded& cell, const glm::dvec2& local) { count += cell.raise(local, best); });
  return count;
}

}  // namespace nightcity::terrain
