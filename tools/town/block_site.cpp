#include "tools/town/block_site.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace nightcity::town {

using glm::dvec2;

double Side::depth_of(const dvec2& p) const {
  return glm::dot(p - start, inward);
}

Side side_of(const Quad& quad, std::size_t k) {
  const dvec2 edge = quad[(k + 1) % 4] - quad[k];
  const double length = glm::length(edge);
  const dvec2 along = edge / length;
  return {quad[k], along, {-along.y, along.x}, length};
}

BlockSite::BlockSite(const StreetPlan& streets, const Hills& ground, std::uint64_t seed, int i,
                     int j)
    : hills(ground),
      parcel(streets.parcel(i, j)),
      remoteness(streets.remoteness(i, j)),
      random{static_cast<std::int64_t>(seed), 9, i, j} {
  for (std::size_t k = 0; k < 4; ++k) sides[k] = side_of(parcel, k);
}

void BlockSite::stand(BuildingPlan& plan, double storey_m, double plinth_m) const {
  double lowest = std::numeric_limits<double>::infinity(), sum = 0;
  for (const dvec2& p : plan.outline) {
    const double z = hills.height(p);
    lowest = std::min(lowest, z);
    sum += z;
  }
  plan.ground_m = lowest - 0.3;
  plan.eave_m = sum / static_cast<double>(plan.outline.size()) + plinth_m + plan.storeys * storey_m;
}

void BlockSite::roof_over(BuildingPlan& plan, Roof roof, double depth_m, double pitch_degrees) {
  plan.roof = roof;
  const double rise = depth_m / 2 * std::tan(glm::radians(pitch_degrees));
  if (roof == Roof::flat)
    plan.ridge_m = plan.eave_m;
  else if (roof == Roof::shed)
    plan.ridge_m = plan.eave_m + depth_m * std::tan(glm::radians(9.0));
  else if (roof == Roof::mansard)
    plan.ridge_m = plan.eave_m + 3.4 + 0.12 * depth_m;
  else
    plan.ridge_m = plan.eave_m + rise;
}

int BlockSite::core_storeys() {
  const int top = remoteness < 0.35 ? 6 : remoteness < 0.65 ? 5 : 4;
  return random.integer(std::max(2, top - 2), top);
}

const char* BlockSite::core_function() {
  const double pick = random.uniform();
  const double shops = 0.45 - 0.4 * remoteness;
  if (pick < shops) return "31001_1120";         // dwellings with shops
  if (pick < shops + 0.10) return "31001_2020";  // offices
  if (pick < shops + 0.13) return "31001_2071";  // hotel
  if (pick < shops + 0.18) return "31001_2050";  // shops
  return "31001_1010";                           // dwellings
}

int BlockSite::old_year() {
  return random.chance(0.7) ? random.integer(1870, 1914) : random.integer(1920, 2015);
}

BuildingPlan make_rectangle(const dvec2& corner, const dvec2& along, double length, double depth) {
  const dvec2 u = along * length, v = dvec2(-along.y, along.x) * depth;
  BuildingPlan plan;
  plan.outline = {corner, corner + u, corner + u + v, corner + v};
  return plan;
}

}  // namespace nightcity::town
