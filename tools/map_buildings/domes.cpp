// Roofs made of smaller and smaller copies of the outline.
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/map_buildings/centroid.h"
#include "tools/map_buildings/roof_shapes.h"
#include "tools/ring_area.h"

namespace nightcity::map_buildings {
namespace {

constexpr double half_pi = std::numbers::pi / 2;

// A long hall has no dome: half a square's share of a circle's area for its circumference.
bool is_compact(const Ring2& ring) {
  double perimeter = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    perimeter += glm::distance(ring[i], ring[(i + 1) % ring.size()]);
  return 4 * std::numbers::pi * signed_area(ring) >= 0.5 * perimeter * perimeter;
}

struct Level {
  double scale, share;  // of the outline, of the rise
};

// Returns false, and adds nothing, where the outline does not fit. The last level is the top.
bool add_levels(Shell& shell, int count, const std::function<Level(double)>& level_at) {
  const Ring2& ring = shell.outer();
  const auto centre = find_centroid(ring);
  if (!centre || !is_compact(ring) || !sees_each_edge(*centre, ring)) return false;
  const BuildingSizes& sizes = shell.sizes();
  shell.add_walls(ring, [&](const glm::dvec2&) { return sizes.eaves_m; });
  const auto lift = [&](int n) {
    city::Ring out;
    const Level level = level_at(static_cast<double>(n) / count);
    const double height = sizes.eaves_m + shell.rise_m() * level.share;
    for (const glm::dvec2& p : ring)
      out.emplace_back(n == 0 ? p : *centre + (p - *centre) * level.scale, height);
    return out;
  };
  city::Ring low = lift(0);
  const auto next = [&](std::size_t i) { return (i + 1) % ring.size(); };
  for (int n = 1; n < count; ++n) {
    const city::Ring high = lift(n);
    for (std::size_t i = 0; i < ring.size(); ++i)
      shell.add_roof({low[i], low[next(i)], high[next(i)], high[i]});
    low = high;
  }
  const glm::dvec3 top(*centre, sizes.top_m);
  for (std::size_t i = 0; i < ring.size(); ++i) shell.add_roof({low[i], low[next(i)], top});
  return true;
}

}  // namespace

bool add_dome(Shell& shell) {
  constexpr int levels = 8;
  return add_levels(shell, levels, [](double t) {
    return Level{std::cos(half_pi * t), std::sin(half_pi * t)};
  });
}

bool add_onion(Shell& shell) {
  constexpr int levels = 12;
  return add_levels(shell, levels, [](double t) {
    const double c = std::cos(half_pi * t);
    return Level{c * c * (1 + 1.5 * t), t};
  });
}

}  // namespace nightcity::map_buildings
