#include "tools/lights/optics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nightcity {
namespace {

/// A street luminaire is made to spread an even illuminance E over its stretch of road, and from E = I
/// cos^3(gamma) at mounting height 1 follows I = E / cos^3. E here is a plateau: a Gaussian across the road,
/// its middle `forward` mounting heights before the post, and a steeper fall along it, half way down at two
/// mounting heights. That puts the peak near gamma = 65 degrees (a Type II, medium distribution of ANSI/IES
/// RP-8) and nothing above 90: a lamp of this optic sends no light upwards.
double street(double c, double gamma, double forward) {
  constexpr double across = 0.95, along = 2.3;
  if (gamma >= std::numbers::pi / 2 - 1e-9) return 0;
  const double reach = std::tan(gamma);
  const double x = (reach * std::cos(c) - forward) / across, y = reach * std::sin(c) / along;
  const double cosine = std::cos(gamma);
  return std::exp(-x * x - y * y * y * y) / (cosine * cosine * cosine);
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
      return sample_intensity([](double c, double gamma) { return street(c, gamma, 0.45); }, 72, 91);
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
