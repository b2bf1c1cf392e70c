#include "tools/town/roof_details.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "tools/random.h"

namespace nightcity::town {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double dormer_width_m = 1.5, dormer_front_m = 1.4, dormer_setback_m = 0.9;
constexpr double dormer_slope = 0.09;  // of its own roof, rising inwards
constexpr double chimney_m = 0.65, chimney_above_m = 0.9;

city::Polygon surface(city::SurfaceType type, city::Ring ring) {
  city::Polygon polygon;
  polygon.surface = type;
  polygon.exterior = std::move(ring);
  return polygon;
}

/// A slope of the roof with its own axes: x along the eave, y inwards.
struct Slope {
  dvec2 start, along, inward;
  double eave, rise;  // height at y = 0, and per metre of y
  dvec3 at(double x, double y, double z) const { return {start + along * x + inward * y, z}; }
};

RoofDetail dormer(const Slope& slope, double x, double reach) {
  const double x0 = x - dormer_width_m / 2, x1 = x + dormer_width_m / 2, y0 = dormer_setback_m;
  const double foot = slope.eave + slope.rise * y0, top = foot + dormer_front_m;
  const double back = slope.eave + slope.rise * reach;
  RoofDetail detail;
  const auto at = [&](double across, double y, double z) { return slope.at(across, y, z); };
  detail.surfaces = {
      surface(city::SurfaceType::wall,
              {at(x0, y0, foot), at(x1, y0, foot), at(x1, y0, top), at(x0, y0, top)}),
      surface(city::SurfaceType::wall, {at(x1, y0, foot), at(x1, reach, back), at(x1, y0, top)}),
      surface(city::SurfaceType::wall, {at(x0, y0, foot), at(x0, y0, top), at(x0, reach, back)}),
      surface(city::SurfaceType::roof,
              {at(x0, y0, top), at(x1, y0, top), at(x1, reach, back), at(x0, reach, back)})};
  return detail;
}

RoofDetail chimney(const dvec2& centre, const dvec2& along, double low, double high) {
  const dvec2 u = along * (chimney_m / 2), v(-u.y, u.x);
  const dvec2 corners[4] = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
  RoofDetail detail;
  detail.chimney = true;
  city::Ring top;
  for (int k = 0; k < 4; ++k) {
    const dvec2 &a = corners[k], &b = corners[(k + 1) % 4];
    detail.surfaces.push_back(
        surface(city::SurfaceType::wall, {{a, low}, {b, low}, {b, high}, {a, high}}));
    top.emplace_back(a, high);
  }
  detail.surfaces.push_back(surface(city::SurfaceType::roof, std::move(top)));
  return detail;
}

}  // namespace

std::vector<RoofDetail> make_roof_details(const BuildingPlan& plan, std::uint64_t seed,
                                          std::size_t number) {
  std::vector<RoofDetail> details;
  const bool church = std::string_view(plan.function) == "31001_3041";
  if (plan.shape != Shape::quad || plan.roof == Roof::flat || plan.roof == Roof::shed || church)
    return details;
  Random random{static_cast<std::int64_t>(seed), 14, static_cast<std::int64_t>(number)};
  const std::vector<dvec2>& p = plan.outline;
  const double width = glm::distance(p[0], p[1]), half = glm::distance(p[0], p[3]) / 2;
  const dvec2 along = (p[1] - p[0]) / width;

  if (plan.roof == Roof::gabled && plan.storeys > 1 && random.chance(0.75)) {
    const double rise = (plan.ridge_m - plan.eave_m) / half;
    // The line on which the dormer's own roof meets the slope.
    const double reach = dormer_setback_m + dormer_front_m / (rise - dormer_slope);
    const int count = static_cast<int>((width - 1.2) / 3.4);
    if (rise > 0.4 && reach < half - 0.3) {
      for (int side = 0; side < 2; ++side) {
        const dvec2 start = side == 0 ? p[0] : p[2], direction = side == 0 ? along : -along;
        const Slope slope{start, direction, {-direction.y, direction.x}, plan.eave_m, rise};
        for (int n = 0; n < count; ++n)
          details.push_back(dormer(slope, width * (n + 0.5) / count, reach));
      }
    }
  }
  // Chimneys stand on the ridge; a pyramid has none to stand on.
  const bool ridge =
      plan.roof == Roof::gabled || plan.roof == Roof::mansard || width > 2 * half + 3;
  if (ridge) {
    const dvec2 west = (p[0] + p[3]) * 0.5;
    const double low = plan.ridge_m - 0.8, high = plan.ridge_m + chimney_above_m;
    details.push_back(chimney(west + along * (width * random.range(0.35, 0.65)), along, low, high));
    if (plan.storeys > 2)
      details.push_back(chimney(west + along * (width - 1.0), along, low, high));
  }
  return details;
}

}  // namespace nightcity::town
