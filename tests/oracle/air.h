// Air that weakens light and scatters it once, in double, by quadrature.
#pragma once

#include <glm/vec3.hpp>

namespace nightcity::oracle {

/// Extinction at a height of y is `extinction` * exp(-(y - level) / scale_height_m), 1/m.
struct Air {
  double extinction = 0;      // at `level`, 1/m; 0 = clear air
  double scale_height_m = 0;  // 0 = the same at all heights
  double level = 0;           // m
  double asymmetry = 0;
  double albedo = 1;    // the share of the extinction that scatters
  double step_m = 0.1;  // of the march along a camera ray
};

/// Returns the extinction at a height, 1/m.
double extinction_at(const Air& air, double height);

/// Returns the share of light that gets from one point to another.
double transmittance(const Air& air, const glm::dvec3& from, const glm::dvec3& to);

/// Returns the phase function of Henyey and Greenstein (1941), 1/sr, at the cosine between the ways
/// before and after.
double phase(const Air& air, double cosine);

}  // namespace nightcity::oracle
