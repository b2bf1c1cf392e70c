// The lamps of a stretch of road: arrangement, spacing and flux that bring it to its lighting
// class.
#pragma once

#include "tools/layout/road_illuminance.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lighting_class.h"
#include "tools/streets/street_network.h"

namespace nightcity::layout {

struct LampDesign {
  Arrangement arrangement = Arrangement::single;
  double spacing_m = 0;
  double flux_lm = 0;  // when new; the class must still be met by maintenance_factor of it
  FieldSummary field;  // with new luminaires
  bool meets_class = false;
};

/// Returns what lamps make of a street's class.
const lights::RoadLighting& lighting_of(const streets::Street& street);

/// Returns how far a post stands behind the kerb, in metres: the clearance of 0.5 m at town speeds
/// (RASt 06, 4.2), less beside paths.
double setback_m(const lights::RoadLighting& road);

/// Returns the arrangement for a width and a mounting height (Global Street Design Guide): one side
/// up to a width of about the height, staggered up to about 1.5 times the height, both sides
/// beyond. The limits lie halfway between the guide's values.
Arrangement arrangement_for(double width_m, double mounting_m);

/// Returns the smallest flux of the catalogue that is at least `flux_lm`. Makers offer LED
/// street luminaires in steps of about an eighth; the series R20 from 500 to 63,000 lm stands
/// for their lists.
double luminaire_package(double flux_lm);
constexpr double min_package_lm = 500, max_package_lm = 63000;

/// Returns the widest spacing, of 3.0 down to 2.5 mounting heights (the guide's range; 2.0 where
/// the class's uniformity asks for it), whose smallest sufficient package keeps the average within
/// the class. If there is none, returns the most even one. `profile` is in candela per lumen.
LampDesign design_lamps(const lights::RoadLighting& road, double width_m, Arrangement arrangement,
                        const lights::LightingClass& wanted, const lights::Photometry& profile);

}  // namespace nightcity::layout
