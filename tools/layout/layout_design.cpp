#include "tools/layout/layout_design.h"

#include <algorithm>
#include <cmath>

namespace nightcity::layout {

const lights::RoadLighting& lighting_of(const streets::Street& street) {
  return lights::find_road_lighting(*street.road.road_class);
}

double setback_m(const lights::RoadLighting& road) {
  return road.tier == roads::RoadTier::path ? 0.3 : 0.5;
}

Arrangement arrangement_for(double width_m, double mounting_m) {
  if (width_m <= 1.25 * mounting_m) return Arrangement::single;
  return width_m <= 1.75 * mounting_m ? Arrangement::staggered : Arrangement::opposite;
}

double luminaire_package(double flux_lm) {
  constexpr double steps[] = {1.00, 1.12, 1.25, 1.40, 1.60, 1.80, 2.00, 2.24, 2.50, 2.80,
                              3.15, 3.55, 4.00, 4.50, 5.00, 5.60, 6.30, 7.10, 8.00, 9.00};
  for (double decade = 100; decade < max_package_lm; decade *= 10)
    for (const double step : steps) {
      const double package = step * decade;
      if (package >= min_package_lm && package >= flux_lm * (1 - 1e-9)) return package;
      if (package >= max_package_lm) break;
    }
  return max_package_lm;
}

LampDesign design_lamps(const lights::RoadLighting& road, double width_m, Arrangement arrangement,
                        const lights::LightingClass& wanted, const lights::Photometry& profile) {
  LampRow row;
  row.arrangement = arrangement;
  row.width_m = width_m;
  row.height_m = road.mounting_m;
  row.overhang_m = std::min(road.outreach_m - setback_m(road), width_m / 2);
  row.profile = &profile;

  LampDesign best;
  for (int tenths = 30; tenths >= 20; --tenths) {
    row.spacing_m = road.mounting_m * tenths / 10;
    const FieldSummary per_lumen = row_illuminance(row);
    LampDesign design{arrangement, row.spacing_m, 0, {}, false};
    design.flux_lm =
        luminaire_package(wanted.average_lx / (lights::maintenance_factor * per_lumen.average_lx));
    design.field = {per_lumen.average_lx * design.flux_lm, per_lumen.min_lx * design.flux_lm};
    const double average = design.field.average_lx * lights::maintenance_factor;
    const double least = design.field.min_lx * lights::maintenance_factor;
    design.meets_class = average >= wanted.average_lx &&
                         average <= wanted.average_lx * lights::max_excess &&
                         least >= wanted.min_lx && design.field.uniformity() >= wanted.uniformity;
    if (design.meets_class) return design;
    if (tenths >= 25 &&
        (best.spacing_m == 0 || design.field.uniformity() > best.field.uniformity()))
      best = design;
  }
  return best;
}

}  // namespace nightcity::layout
