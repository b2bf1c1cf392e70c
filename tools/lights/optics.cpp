#include "tools/lights/optics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nightcity {
namespace {

/// A street luminaire is made to spread an even illuminance E over its stretch of road, and from E = I
/// cos^3(gamma) at mounting height 1 follows I = E / cos^3. E here is a bell across the road, its middle
/// `forward` mounting heights before the post, and along it the sum of a wide and a narrow bell. Its widths
/// were chosen so that it lights a road as the measured road luminaires do that the tests compare it with: 57
/// % of the flux on a road as wide as the lamps are high, overall uniformity 0.42 at a spacing of four
/// heights, a peak of 620 cd/klm near 65 degrees. Nothing goes above 90 degrees: a lamp of this optic sends
/// no light upwards.
double street(double c, double gamma, double forward) {
  constexpr double across = 0.85, along = 2.2, near_along = 0.9, near_share = 0.6;
  if (gamma >= std::numbers::pi / 2 - 1e-9) return 0;
  const double reach = std::tan(gamma), x = (reach * std::cos(c) - forward) / across,
               y = reach * std::sin(c);
  const double far = y / along, near = y / near_along, cosine = std::cos(gamma);
  const double bells =
      (1 - near_share) * std::exp(-far * far) + near_share * std::exp(-near * near);
  return std::exp(-x * x) * bells / (cosine * cosine * cosine);
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// An opal globe, darker below where the post stands and above where the shade is.
double lantern(double gamma) {
  const double degrees = gamma * 180 / std::numbers::pi;
  const double post = 0.35 + 0.65 * smooth(5, 35, degrees);
  const double shade = 1 - 0.85 * smooth(85, 140, degrees);
  return post * shade;
}

/// Half the peak at 18 degrees off the axis, nothing behind.
double floodlight(double gamma) {
  return gamma < std::numbers::pi / 2 ? std::pow(std::cos(gamma), 14) : 0;
}

}  // namespace

const char* name_of(Optic optic) {
  constexpr const char* names[] = {"street", "central", "lantern", "floodlight"};
  return names[static_cast<int>(optic)];
}

Photometry make_optic(Optic optic) {
  switch (optic) {
    case Optic::street:
      return sample_intensity([](double c, double gamma) { return street(c, gamma, 0.6); }, 72, 91);
    case Optic::central:
      return sample_intensity([](double c, double gamma) { return street(c, gamma, 0); }, 72, 91);
    case Optic::lantern:
      return sample_intensity([](double, double gamma) { return lantern(gamma); }, 1, 91);
    case Optic::floodlight:
      break;
  }
  return sample_intensity([](double, double gamma) { return floodlight(gamma); }, 1, 181);
}

}  // namespace nightcity
