#include "tools/town/trees.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tools/in_ring.h"
#include "tools/line.h"
#include "tools/random.h"

namespace nightcity::town {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double spacing_m = 9;

double density(BlockUse use) {
  switch (use) {
    case BlockUse::park:
      return 0.8;
    case BlockUse::houses:
      return 0.45;
    case BlockUse::slabs:
      return 0.5;
    case BlockUse::perimeter:
    case BlockUse::courtyard:
      return 0.35;
    case BlockUse::market:
    case BlockUse::hall:
      break;
  }
  return 0;
}

double distance_to_edge(const std::vector<dvec2>& outline, const dvec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const dvec2& end = outline[(k + 1) % outline.size()];
    best = std::min(best, find_distance(p, outline[k], end));
  }
  return best;
}

bool clear_of(const BuildingPlan& house, const dvec2& p, double clearance) {
  if (distance_to_edge(house.outline, p) < clearance) return false;
  if (!house.hole.empty() && distance_to_edge(house.hole, p) < clearance) return false;
  return !in_ring(house.outline, p) || (!house.hole.empty() && in_ring(house.hole, p));
}

}  // namespace

std::vector<TreePlan> plan_trees(const StreetPlan& streets, const Hills& hills,
                                 const std::vector<BuildingPlan>& houses, std::uint64_t seed, int i,
                                 int j) {
  std::vector<TreePlan> trees;
  const BlockUse use = streets.use(i, j);
  const double share = density(use);
  if (share == 0) return trees;
  Random random{static_cast<std::int64_t>(seed), 15, i, j};
  const Quad parcel = streets.parcel(i, j);
  const std::vector<dvec2> edge(parcel.begin(), parcel.end());
  const std::vector<dvec2> path = {parcel[0], parcel[2]};
  dvec2 low(parcel[0]), high(parcel[0]);
  for (const dvec2& p : parcel) low = glm::min(low, p), high = glm::max(high, p);
  for (double y = low.y; y < high.y; y += spacing_m)
    for (double x = low.x; x < high.x; x += spacing_m) {
      TreePlan tree;
      tree.foot = {x + random.range(0, 5), y + random.range(0, 5)};
      tree.height_m = random.range(6, 12);
      tree.crown_radius_m = 0.24 * tree.height_m;
      const double clearance = tree.crown_radius_m + 1.2;
      if (!random.chance(share) || !in_ring(edge, tree.foot) ||
          distance_to_edge(edge, tree.foot) < clearance + 1.5)
        continue;
      if (use == BlockUse::park && distance_to_edge(path, tree.foot) < clearance + 1.5) continue;
      if (!std::all_of(houses.begin(), houses.end(), [&](const BuildingPlan& house) {
            return clear_of(house, tree.foot, clearance);
          }))
        continue;
      tree.ground_m = hills.height(tree.foot);
      trees.push_back(tree);
    }
  return trees;
}

std::vector<city::Ring> make_tree_surfaces(const TreePlan& tree) {
  constexpr std::size_t sides = 6;
  const double trunk = 0.12 + 0.015 * tree.height_m, fork = tree.ground_m + 0.28 * tree.height_m;
  const double top = tree.ground_m + tree.height_m;
  const auto ring = [&](double radius, double z) {
    std::array<dvec3, sides> points;
    for (std::size_t n = 0; n < sides; ++n) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(n) / sides;
      points[n] = {tree.foot + radius * dvec2(std::cos(angle), std::sin(angle)), z};
    }
    return points;
  };
  std::vector<city::Ring> rings;
  // A trunk of four sides, from a little below the ground into the crown.
  const dvec2 corners[4] = {{-trunk, -trunk}, {trunk, -trunk}, {trunk, trunk}, {-trunk, trunk}};
  for (int n = 0; n < 4; ++n) {
    const dvec2 a = tree.foot + corners[n], b = tree.foot + corners[(n + 1) % 4];
    rings.push_back(
        {{a, tree.ground_m - 0.2}, {b, tree.ground_m - 0.2}, {b, fork + 0.5}, {a, fork + 0.5}});
  }
  // A crown of two rings between a lower and an upper point.
  const auto lower = ring(0.85 * tree.crown_radius_m, fork + 0.2 * tree.height_m);
  const auto upper = ring(tree.crown_radius_m, fork + 0.42 * tree.height_m);
  for (std::size_t n = 0; n < sides; ++n) {
    const std::size_t next = (n + 1) % sides;
    rings.push_back({{tree.foot, fork}, lower[next], lower[n]});
    rings.push_back({lower[n], lower[next], upper[next]});
    rings.push_back({lower[n], upper[next], upper[n]});
    rings.push_back({upper[n], upper[next], {tree.foot, top}});
  }
  return rings;
}

}  // namespace nightcity::town
