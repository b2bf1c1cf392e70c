// Light distributions of floodlights for areas and of downlights.
#pragma once

#include "tools/lights/photometry.h"

namespace nightcity::map_lights {

/// Returns a full cut-off floodlight for the long side of an area, with C = 0 across it and one
/// lumen. On the ground its illuminance falls as cos^2(pi x / 2 reach) with the distance x across,
/// in mounting heights, so that two such sides at a distance `reach` from each other add up to an
/// even field; along the side it is a bell curve for masts two mounting heights apart. I = E /
/// cos^3(gamma) gives the intensity.
lights::Photometry make_area_floodlight(double reach);

/// Returns a Lambertian downlight of one lumen: I = cos(gamma) / pi.
lights::Photometry make_downlight();

/// Returns the narrow floodlight of street-lamp optics (optics.h), of one lumen.
lights::Photometry make_spotlight();

}  // namespace nightcity::map_lights
