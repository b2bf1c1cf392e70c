// Direct illuminance of luminaires on surfaces of any direction, and the flux that reaches a wanted
// mean.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/lights/photometry.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::map_lights {

struct TargetPoint {
  glm::dvec3 place{0};
  glm::dvec3 normal{0, 0, 1};  // unit
};

/// Returns the illuminance in lux that a luminaire gives at a point, without obstacles:
/// E = I(C, gamma) cos(incidence) / d^2. `profile`: candela per lumen; lamp.profile is not read.
double find_illuminance(const lights::PlacedLamp& lamp, const lights::Photometry& profile,
                        const TargetPoint& point);

/// Gives each luminaire the same flux, so that the mean illuminance over the points is
/// `maintained_lx` when the maintenance factor (lighting_class.h) is all that is left of it.
/// `profile` is of one lumen. Returns whether it is possible: not where no light arrives, nor where
/// one luminaire would need more than `max_flux_lm`.
bool reach_mean(std::span<lights::PlacedLamp> lamps, const lights::Photometry& profile,
                std::span<const TargetPoint> points, double maintained_lx);

/// An assumption: ten floodlights of 200,000 lm on one mast.
constexpr double max_flux_lm = 2e6;

}  // namespace nightcity::map_lights
