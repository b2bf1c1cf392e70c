#include "tools/town/open_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace nightcity::town {
namespace {

using glm::dvec2;

void add_house(BlockSite& site, BuildingPlan& plan, double width, double depth) {
  plan.storeys = site.random.chance(0.65) ? 1 : 2;
  plan.year = site.random.integer(1925, 2020);
  plan.function = "31001_1010";
  site.stand(plan, 2.9, 0.5);
  const double pick = site.random.uniform();
  const Roof roof = pick < 0.55                                  ? Roof::gabled
                    : pick < 0.80                                ? Roof::hipped
                    : pick < 0.88 || std::abs(width - depth) < 1 ? Roof::pyramid
                    : pick < 0.94                                ? Roof::shed
                                                                 : Roof::flat;
  site.roof_over(plan, roof, depth, site.random.range(28, 48));
  site.plans.push_back(std::move(plan));
}

}  // namespace

void plan_courtyard(BlockSite& site) {
  const double setback = site.random.range(2, 5), depth = site.random.range(13, 15);
  const Quad outer = inset_quad(site.parcel, {setback, setback, setback, setback});
  const Quad inner = inset_quad(outer, {depth, depth, depth, depth});
  for (std::size_t k = 0; k < 4; ++k)
    for (const std::size_t across : {(k + 2) % 4, (k + 3) % 4})
      if (side_of(outer, k).depth_of(inner[across]) < depth + 8) return plan_houses(site);
  BuildingPlan plan;
  plan.shape = Shape::courtyard;
  plan.outline.assign(outer.begin(), outer.end());
  plan.hole.assign(inner.begin(), inner.end());
  plan.storeys = site.random.integer(3, 4);
  constexpr const char* uses[] = {"31001_3012", "31001_3021", "31001_3034", "31001_2020"};
  plan.function = uses[site.random.integer(0, 3)];  // town hall, school, museum, offices
  plan.year = site.random.integer(1880, 1980);
  site.stand(plan, 4.0, 1.0);
  const double slope_deg = site.random.range(30, 40);
  site.roof_over(plan, site.random.chance(0.6) ? Roof::gabled : Roof::flat, depth, slope_deg);
  site.plans.push_back(std::move(plan));
}

void plan_houses(BlockSite& site) {
  const double setback = site.random.range(3.5, 6), max_depth = 12.5, gap = 3.2;
  // The strip beside a street that only its own houses may use.
  const double clear = setback + max_depth + gap;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool first_choice = k % 2 == 0;  // sides 0 and 2 build up to the corners
    double s = setback;
    while (s < site.sides[k].length - setback - 9) {
      const double lot = site.random.range(13, 19);
      const double width = std::min(site.random.range(9, 14), lot - gap),
                   depth = site.random.range(8.5, max_depth);
      const double front = setback + site.random.range(0, max_depth - depth);
      BuildingPlan plan =
          make_rectangle(site.sides[k].at(s, front), site.sides[k].along, width, depth);
      s += lot;
      bool fits = true;
      for (std::size_t other = 0; other < 4; ++other) {
        if (other == k) continue;
        const double distance = first_choice && other % 2 == 1 ? setback : clear;
        for (const dvec2& p : plan.outline)
          fits = fits && site.sides[other].depth_of(p) >= distance;
      }
      if (fits) add_house(site, plan, width, depth);
    }
  }
}

void plan_slabs(BlockSite& site) {
  const std::size_t k = site.sides[0].length > site.sides[1].length ? 0 : 1;
  const Side &near = site.sides[k], &far = site.sides[k + 2];
  const double depth = 12, setback = 7;
  for (const Side* side : {&near, &far}) {
    BuildingPlan plan =
        make_rectangle(side->at(14, setback), side->along, side->length - 28, depth);
    const Side& opposite = side == &near ? far : near;
    bool fits = side->length > 50;
    for (const dvec2& p : plan.outline) fits = fits && opposite.depth_of(p) > setback + depth + 6;
    for (std::size_t other : {(k + 1) % 4, (k + 3) % 4})
      for (const dvec2& p : plan.outline) fits = fits && site.sides[other].depth_of(p) > 4;
    if (!fits) continue;
    plan.storeys = site.random.integer(5, 9);
    plan.year = site.random.integer(1960, 1985);
    site.stand(plan, 2.8, 1.0);
    site.roof_over(plan, Roof::flat, depth, 0);
    site.plans.push_back(std::move(plan));
  }
  if (site.plans.empty()) plan_houses(site);
}

void plan_hall(BlockSite& site) {
  const dvec2 centre = (site.parcel[0] + site.parcel[1] + site.parcel[2] + site.parcel[3]) / 4.0;
  double room = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) room = std::min(room, site.sides[k].depth_of(centre));
  const double half = (room - 3) / std::numbers::sqrt2;
  BuildingPlan plan =
      make_rectangle(centre - site.sides[0].along * half - site.sides[0].inward * half,
                     site.sides[0].along, 2 * half, 2 * half);
  plan.storeys = 1;
  plan.year = site.random.integer(1975, 2020);
  plan.function = site.random.chance(0.6) ? "31001_2050" : "31001_2111";  // shop, factory
  site.stand(plan, site.random.range(5, 8), 0.2);
  site.roof_over(plan, site.random.chance(0.7) ? Roof::flat : Roof::shed, 2 * half, 0);
  site.plans.push_back(std::move(plan));
}

}  // namespace nightcity::town
