// The lights of SPEC.md 3.3 in double: jittered points on each, and what they send to a receiver.
#pragma once

#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "oracle/oracle.h"

namespace nightcity::oracle {

/// A point of a light, and the illuminance that it alone gives to a surface at the receiver that
/// faces it; lux per channel. The points of a light sum to the light's illuminance.
struct LightPoint {
  glm::dvec3 point;
  glm::dvec3 illuminance;
};

/// Appends strata * strata points, one for a point light, or none if the light sends nothing to the
/// receiver.
void append_points(const Lights& lights, const Light& light, const glm::dvec3& receiver, int strata,
                   std::mt19937& random, std::vector<LightPoint>& out);

/// Returns the luminance of the light's surface seen along unit `to`, which points away from the
/// light; cd/m2 per channel.
glm::dvec3 seen_luminance(const Lights& lights, const Light& light, const glm::dvec3& to);

}  // namespace nightcity::oracle
