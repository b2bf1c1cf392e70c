#include "tools/town/perimeter_block.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace nightcity::town {
namespace {

using glm::dvec2;

void add_corner_house(BlockSite& site, std::size_t k, double reach, double depth,
                      const dvec2& inner, bool old_town) {
  const Side &a = site.sides[(k + 3) % 4], &b = site.sides[k];
  BuildingPlan plan;
  plan.shape = Shape::corner;
  plan.outline = {a.at(a.length - reach, 0), site.parcel[k], b.at(reach, 0),
                  b.at(reach, depth),        inner,          a.at(a.length - reach, depth)};
  plan.storeys = site.core_storeys();
  plan.function = site.core_function();
  plan.year = site.old_year();
  site.stand(plan, old_town ? 3.5 : 3.0, 0.8);
  const double slope_deg = site.random.range(35, 45);
  site.roof_over(plan, site.random.chance(0.8) ? Roof::gabled : Roof::flat, depth, slope_deg);
  site.plans.push_back(std::move(plan));
}

void add_row(BlockSite& site, const Side& side, double from, double to, double depth,
             bool old_town) {
  const int lots =
      std::max(1, static_cast<int>(std::lround((to - from) / site.random.range(9, 15))));
  const int common_storeys = site.core_storeys();
  for (int n = 0; n < lots; ++n) {
    const double s0 = from + (to - from) * n / lots, s1 = from + (to - from) * (n + 1) / lots;
    if (site.random.chance(0.02)) continue;  // a gap in the row
    BuildingPlan plan;
    plan.outline = {side.at(s0, 0), side.at(s1, 0), side.at(s1, depth), side.at(s0, depth)};
    plan.storeys = std::clamp(common_storeys + site.random.integer(-1, 1), 2, 7);
    plan.function = site.core_function();
    plan.year = site.old_year();
    site.stand(plan, old_town ? site.random.range(3.3, 3.6) : site.random.range(2.9, 3.1), 0.8);
    const double pick = site.random.uniform();
    const Roof roof = pick < 0.62   ? Roof::gabled
                      : pick < 0.78 ? Roof::mansard
                      : pick < 0.92 ? Roof::flat
                                    : Roof::shed;
    site.roof_over(plan, roof, depth, site.random.range(35, 47));
    site.plans.push_back(std::move(plan));
  }
}

/// Plans the lower house in the yard of a deep block.
void add_rear_house(BlockSite& site, const Quad& yard) {
  const dvec2 centre = (yard[0] + yard[1] + yard[2] + yard[3]) / 4.0;
  double room = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) room = std::min(room, side_of(yard, k).depth_of(centre));
  if (room < 11 || site.random.chance(0.3)) return;
  // Inside the circle that touches the yard's walls.
  const double half = (room - 4) / std::numbers::sqrt2;
  BuildingPlan plan =
      make_rectangle(centre - site.sides[0].along * half - site.sides[0].inward * (half * 0.7),
                     site.sides[0].along, 2 * half, 1.4 * half);
  plan.storeys = site.random.integer(1, 3);
  plan.function = site.random.chance(0.5) ? "31001_2143" : "31001_1010";  // store, dwellings
  plan.year = site.old_year();
  site.stand(plan, 3.2, 0.2);
  site.roof_over(plan, site.random.chance(0.5) ? Roof::shed : Roof::flat, 1.4 * half, 30);
  site.plans.push_back(std::move(plan));
}

}  // namespace

bool plan_perimeter(BlockSite& site) {
  const double depth = site.random.range(11.0, 13.5);
  const Quad inner = inset_quad(site.parcel, {depth, depth, depth, depth});
  double reach[4];  // how far a corner house's inner corner lies along its sides
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t before = (k + 3) % 4;
    for (const std::size_t across : {(k + 2) % 4, (k + 3) % 4})
      if (site.sides[k].depth_of(inner[across]) < depth + 7) return false;
    const double here = glm::dot(inner[k] - site.parcel[k], site.sides[k].along);
    const double there = glm::dot(site.parcel[k] - inner[k], site.sides[before].along);
    reach[k] = std::max(here, there) + site.random.range(2.5, 6.0);
  }
  for (std::size_t k = 0; k < 4; ++k)
    if (site.sides[k].length < reach[k] + reach[(k + 1) % 4] + 8) return false;

  const bool old_town = site.random.chance(0.8);
  for (std::size_t k = 0; k < 4; ++k) {
    add_corner_house(site, k, reach[k], depth, inner[k], old_town);
    add_row(site, site.sides[k], reach[k], site.sides[k].length - reach[(k + 1) % 4], depth,
            old_town);
  }
  add_rear_house(site, inner);
  return true;
}

}  // namespace nightcity::town
