// What lamps a stretch of road gets: arrangement, spacing and flux that bring it to its lighting class.
#pragma once

#include "tools/layout/road_illuminance.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lighting_class.h"
#include "tools/streets/street_network.h"

namespace nightcity::layout {

struct LampDesign {
  Arrangement arrangement = Arrangement::single;
  double spacing_m = 0;
  double flux_lm = 0;  // new: maintenance_factor of it is left when the class must still be met
  FieldSummary field;  // with new luminaires
  bool meets_class = false;
};

/// Returns what lamps make of a street's class.
const RoadLighting& lighting_of(const streets::Street& street);

/// Behind the kerb: the clearance of 0.5 m that a kerb gives at town speeds (RASt 06, 4.2), less by paths.
double setback_m(const RoadLighting& road);

/// From the width over the mounting height (Global Street Design Guide): one side up to about the height,
/// staggered up to about 1.5 times, both sides beyond. Halfway between the guide's values is where it
/// changes.
Arrangement arrangement_for(double width_m, double mounting_m);

/// The least luminaire of the catalogue with at least this flux. Makers set LED street luminaires at the
/// works in steps of about an eighth: the series R20 from 500 to 63,000 lm stands for their lists.
double luminaire_package(double flux_lm);
constexpr double min_package_lm = 500, max_package_lm = 63000;

/// The widest spacing of 3.0 down to 2.5 mounting heights (the guide's range; 2.0 where the class's
/// uniformity wants it) whose least sufficient package keeps the average within the class. Where none does,
/// the most even. `profile` in candela per lumen.
LampDesign design_lamps(const RoadLighting& road, double width_m, Arrangement arrangement,
                        const LightingClass& wanted, const Photometry& profile);

}  // namespace nightcity::layout
