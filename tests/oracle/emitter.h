// Lights of SPEC.md 3.3 in double: a jittered set of points on each, and what they send to a receiver.
#pragma once

#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "oracle/oracle.h"

namespace nightcity::oracle {

/// A point of a light and the illuminance, per channel in lux, it alone would give a surface at the receiver
/// that faces it; the points of one light sum to the light's.
struct LightPoint {
  glm::dvec3 point;
  glm::dvec3 illuminance;
};

/// Appends strata * strata points (a point light: one). None where the light sends nothing to the receiver.
void append_points(const Lights& lights, const Light& light, const glm::dvec3& receiver, int strata,
                   std::mt19937& random, std::vector<LightPoint>& out);

/// Luminance of the light's surface seen along `to`, unit, away from the light; cd/m2 per channel.
glm::dvec3 seen_luminance(const Lights& lights, const Light& light, const glm::dvec3& to);

}  // namespace nightcity::oracle
