#include "tools/map_buildings/roofs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

namespace nightcity::map_buildings {
namespace {

using Ring2 = std::vector<glm::dvec2>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The rectangle of least area round an outline: one of its sides lies on an edge of the convex hull
// (Freeman and Shapira 1975), and edges of the outline itself are enough for buildings.
struct Rectangle {
  glm::dvec2 along{1, 0};  // of the longer side
  glm::dvec2 middle{0, 0};
  double length = 0, width = 0;
};

Rectangle find_rectangle(const Ring2& ring) {
  Rectangle best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    if (glm::length(edge) < 1e-6) continue;
    const glm::dvec2 u = glm::normalize(edge), v(-u.y, u.x);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec2& p : ring) {
      const glm::dvec2 q(glm::dot(p, u), glm::dot(p, v));
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
    const glm::dvec2 size = high - low, centre = (low + high) / 2.0;
    if (size.x * size.y >= least) continue;
    least = size.x * size.y;
    best.middle = centre.x * u + centre.y * v;
    const bool longer = size.x >= size.y;
    best.along = longer ? u : v;
    best.length = std::max(size.x, size.y);
    best.width = std::min(size.x, size.y);
  }
  return best;
}

city::Ring lift(const Ring2& ring, const std::function<double(const glm::dvec2&)>& height) {
  city::Ring out;
  for (const glm::dvec2& p : ring) out.emplace_back(p, height(p));
  return out;
}

city::Polygon make_polygon(city::SurfaceType surface, city::Ring exterior) {
  city::Polygon polygon;
  polygon.surface = surface;
  polygon.exterior = std::move(exterior);
  return polygon;
}

class Shell {
 public:
  Shell(const Outline& outline, const BuildingSizes& sizes)
      : outline_(outline), sizes_(sizes), floor_(outline.outer) {}

  // Adds the floor, and gives all away.
  std::vector<city::Polygon> take() {
    // A part that hangs in the air has no ground surface, because the ground
    // would be made through it.
    const auto surface =
        sizes_.foot_m > 0 ? city::SurfaceType::outer_ceiling : city::SurfaceType::ground;
    city::Polygon floor = make_polygon(surface, level(floor_, sizes_.foot_m));
    for (const Ring2& hole : outline_.holes) floor.interiors.push_back(level(hole, sizes_.foot_m));
    std::reverse(floor.exterior.begin(), floor.exterior.end());
    for (city::Ring& hole : floor.interiors) std::reverse(hole.begin(), hole.end());
    polygons_.push_back(std::move(floor));
    return std::move(polygons_);
  }

  // A roof in one plane.
  void add_plane(const std::function<double(const glm::dvec2&)>& height) {
    city::Polygon roof = make_polygon(city::SurfaceType::roof, lift(outline_.outer, height));
    add_walls(outline_.outer, height);
    for (const Ring2& hole : outline_.holes) {
      roof.interiors.push_back(lift(hole, height));
      add_walls(hole, height);
    }
    polygons_.push_back(std::move(roof));
  }

  // Two planes that meet at the ridge. Returns false, and adds nothing, where the ridge's line cuts
  // the outline more than twice.
  bool add_gable(const Rectangle& box, const glm::dvec2& along, double half_width) {
    const glm::dvec2 across(-along.y, along.x);
    const auto side = [&](const glm::dvec2& p) { return glm::dot(p - box.middle, across); };
    const double rise = sizes_.top_m - sizes_.eaves_m;
    const auto height = [&](const glm::dvec2& p) {
      return sizes_.top_m - rise * std::min(1.0, std::abs(side(p)) / half_width);
    };
    // The outline with a vertex of its own at both ends of the ridge.
    Ring2 ring;
    std::vector<std::size_t> ends;
    constexpr double on_ridge_m = 1e-6;
    const Ring2& outer = outline_.outer;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const glm::dvec2 &a = outer[i], &b = outer[(i + 1) % outer.size()];
      const double from = side(a), to = side(b);
      if (std::abs(from) <= on_ridge_m) ends.push_back(ring.size());
      ring.push_back(a);
      if (std::abs(from) <= on_ridge_m || std::abs(to) <= on_ridge_m || (from > 0) == (to > 0))
        continue;
      ends.push_back(ring.size());
      ring.push_back(a + (b - a) * (from / (from - to)));
    }
    if (ends.size() != 2 || ends[1] - ends[0] < 2 || ring.size() - ends[1] + ends[0] < 2)
      return false;
    const auto first = ring.begin() + static_cast<std::ptrdiff_t>(ends[0]);
    const auto second = ring.begin() + static_cast<std::ptrdiff_t>(ends[1]);
    Ring2 one(first, second + 1), other(second, ring.end());
    other.insert(other.end(), ring.begin(), first + 1);
    add_walls(ring, height);
    floor_ = ring;
    polygons_.push_back(make_polygon(city::SurfaceType::roof, lift(one, height)));
    polygons_.push_back(make_polygon(city::SurfaceType::roof, lift(other, height)));
    return true;
  }

  bool add_pyramid() {
    const Ring2& ring = outline_.outer;
    const std::optional<glm::dvec2> top = find_centroid(ring);
    if (!top) return false;
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (cross(ring[(i + 1) % ring.size()] - ring[i], *top - ring[i]) <= 1e-6) return false;
    add_walls(ring, [&](const glm::dvec2&) { return sizes_.eaves_m; });
    for (std::size_t i = 0; i < ring.size(); ++i)
      polygons_.push_back(
          make_polygon(city::SurfaceType::roof,
                       city::Ring{glm::dvec3(ring[i], sizes_.eaves_m),
                                  glm::dvec3(ring[(i + 1) % ring.size()], sizes_.eaves_m),
                                  glm::dvec3(*top, sizes_.top_m)}));
    return true;
  }

  // Over four corners, its ridge half of the shorter sides' mean away from these.
  bool add_hip() {
    const Ring2& ring = outline_.outer;
    if (ring.size() != 4) return false;
    for (std::size_t i = 0; i < 4; ++i)
      if (cross(ring[(i + 1) % 4] - ring[i], ring[(i + 2) % 4] - ring[(i + 1) % 4]) <= 1e-6)
        return false;
    const auto length = [&](std::size_t i) { return glm::distance(ring[i], ring[(i + 1) % 4]); };
    const std::size_t s = length(0) + length(2) >= length(1) + length(3) ? 0 : 1;  // a long side
    const auto corner = [&](std::size_t i) { return ring[(s + i) % 4]; };
    const glm::dvec2 from = (corner(3) + corner(0)) / 2.0, to = (corner(1) + corner(2)) / 2.0;
    const double inset = (length(s + 1) + length((s + 3) % 4)) / 4, whole = glm::distance(from, to);
    if (whole < 2 * inset + 0.01) return add_pyramid();
    const glm::dvec2 step = (to - from) / whole * inset;
    const glm::dvec3 a(from + step, sizes_.top_m), b(to - step, sizes_.top_m);
    const auto eave = [&](std::size_t i) { return glm::dvec3(corner(i), sizes_.eaves_m); };
    add_walls(ring, [&](const glm::dvec2&) { return sizes_.eaves_m; });
    for (city::Ring face : {city::Ring{eave(0), eave(1), b, a}, city::Ring{eave(1), eave(2), b},
                            city::Ring{eave(2), eave(3), a, b}, city::Ring{eave(3), eave(0), a}})
      polygons_.push_back(make_polygon(city::SurfaceType::roof, std::move(face)));
    return true;
  }

 private:
  static std::optional<glm::dvec2> find_centroid(const Ring2& ring) {
    double area = 0;
    glm::dvec2 sum{0};
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const double part = cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
      area += part;
      sum += part * (ring[i] + ring[i + 1] - 2.0 * ring[0]) / 3.0;
    }
    if (!(area > 1e-6)) return {};
    return ring[0] + sum / area;
  }

  static city::Ring level(const Ring2& ring, double height) {
    return lift(ring, [height](const glm::dvec2&) { return height; });
  }

  void add_walls(const Ring2& ring, const std::function<double(const glm::dvec2&)>& height) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      polygons_.push_back(
          make_polygon(city::SurfaceType::wall,
                       city::Ring{glm::dvec3(a, sizes_.foot_m), glm::dvec3(b, sizes_.foot_m),
                                  glm::dvec3(b, height(b)), glm::dvec3(a, height(a))}));
    }
  }

  const Outline& outline_;
  const BuildingSizes& sizes_;
  Ring2 floor_;  // the outer ring with the vertices that walls have
  std::vector<city::Polygon> polygons_;
};

// The way that roof:direction says, else across the longer side.
glm::dvec2 find_fall(const BuildingSizes& sizes, const Rectangle& box) {
  if (!sizes.direction_degrees) return {-box.along.y, box.along.x};
  const double angle = *sizes.direction_degrees * std::numbers::pi / 180;
  return {std::sin(angle), std::cos(angle)};
}

// The outline reaches from `low` to `high` along a direction, m.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Extent find_extent(const Outline& outline, const glm::dvec2& along) {
  Extent extent;
  for (const glm::dvec2& p : outline.outer) {
    extent.low = std::min(extent.low, glm::dot(p, along));
    extent.high = std::max(extent.high, glm::dot(p, along));
  }
  return extent;
}

// A plane that falls from the top to the eaves.
void add_skillion(Shell& shell, const Outline& outline, const BuildingSizes& sizes,
                  const Rectangle& box) {
  const glm::dvec2 fall = find_fall(sizes, box);
  const auto [low, high] = find_extent(outline, fall);
  const double slope = (sizes.top_m - sizes.eaves_m) / std::max(high - low, 1e-6);
  shell.add_plane([&, low = low](const glm::dvec2& p) {
    return sizes.top_m - slope * (glm::dot(p, fall) - low);
  });
}

}  // namespace

void fit_slope(const Outline& outline, BuildingSizes& sizes) {
  if (!sizes.slope_degrees || sizes.roof == RoofShape::flat) return;
  const Rectangle box = find_rectangle(outline.outer);
  double run = (sizes.roof == RoofShape::gabled && sizes.across ? box.length : box.width) / 2;
  if (sizes.roof == RoofShape::skillion) {
    const Extent extent = find_extent(outline, find_fall(sizes, box));
    run = extent.high - extent.low;
  }
  set_rise(sizes, run * std::tan(*sizes.slope_degrees * std::numbers::pi / 180));
}

std::vector<city::Polygon> make_shell(const Outline& outline, const BuildingSizes& sizes,
                                      bool& made_flat) {
  Shell shell(outline, sizes);
  const Rectangle box = find_rectangle(outline.outer);
  const bool whole = outline.holes.empty();
  bool done = false;
  switch (sizes.roof) {
    case RoofShape::flat:
      break;
    case RoofShape::skillion:
      add_skillion(shell, outline, sizes, box);
      done = true;
      break;
    case RoofShape::gabled:
      done =
          whole && (sizes.across ? shell.add_gable(box, {-box.along.y, box.along.x}, box.length / 2)
                                 : shell.add_gable(box, box.along, box.width / 2));
      break;
    case RoofShape::hipped:
      done = whole && shell.add_hip();
      break;
    case RoofShape::pyramidal:
      done = whole && shell.add_pyramid();
      break;
  }
  made_flat = !done && sizes.roof != RoofShape::flat;
  if (!done) shell.add_plane([&](const glm::dvec2&) { return sizes.top_m; });
  return shell.take();
}

}  // namespace nightcity::map_buildings
