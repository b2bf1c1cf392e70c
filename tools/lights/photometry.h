// Luminous intensity distributions as the light file stores them: candela per lumen on a regular
// (C, gamma) grid.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/light.h"

namespace nightcity::lights {

/// Intensity as a function of two angles in radians: C turns from the light's tangent towards
/// cross(axis, tangent), and gamma is 0 along the axis.
using Intensity = std::function<double(double c, double gamma)>;

/// One distribution: a row of gamma values for each C, interpolated bilinearly, periodic in C.
struct Photometry {
  std::uint32_t c_count = 1;      // >= 1
  std::uint32_t gamma_count = 2;  // >= 2
  std::vector<double> values;     // c_count * gamma_count, gamma fastest
  double extent_degrees = 180;    // gamma of the last row; dark beyond
};

/// Returns the function sampled on a regular grid.
Photometry sample_intensity(const Intensity& intensity, std::uint32_t c_count,
                            std::uint32_t gamma_count, double extent_degrees = 180);

/// Returns the flux of the bilinear interpolant in closed form, without quadrature error: lumen if
/// the values are candela.
double integrated_flux(const Photometry& photometry);

/// Returns the value of the bilinear interpolant.
double intensity_at(const Photometry& photometry, double c, double gamma);

/// The profiles of a light file under construction; each name is stored once.
class ProfileTable {
 public:
  /// Returns the index of the profile of that name; if there is none yet, scales this one to one
  /// lumen and stores it. Throws std::invalid_argument if a value is negative or not finite or the
  /// flux is not positive; readers of files check that first.
  std::uint32_t add(std::string_view name, const Photometry& photometry);

  std::vector<LightProfile> profiles;
  std::vector<float> data;

 private:
  std::vector<std::string> names_;
};

}  // namespace nightcity::lights
