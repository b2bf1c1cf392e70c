// Luminous intensity distributions as the light file keeps them: candela per lumen on a regular (C, gamma)
// grid.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/light.h"

namespace nightcity {

/// C turns from the light's tangent towards cross(axis, tangent); gamma is 0 along the axis. Both in radians.
using Intensity = std::function<double(double c, double gamma)>;

/// One distribution: C rows of gamma values, bilinear between, wrapping round in C.
struct Photometry {
  std::uint32_t c_count = 1;      // >= 1
  std::uint32_t gamma_count = 2;  // >= 2
  std::vector<double> values;     // c_count * gamma_count, gamma fastest
  double extent_degrees = 180;    // gamma of the last row; dark beyond
};

/// Samples a function on the grid.
Photometry sample_intensity(const Intensity& intensity, std::uint32_t c_count,
                            std::uint32_t gamma_count, double extent_degrees = 180);

/// Flux of the bilinear interpolant, in closed form (no quadrature error): lumen if the values are candela.
double integrated_flux(const Photometry& photometry);

/// Value of the interpolant.
double intensity_at(const Photometry& photometry, double c, double gamma);

/// The profiles of a light file under construction; each name is stored once.
class ProfileTable {
 public:
  /// Scales to one lumen and stores; the index of the profile of that name, old or new. Throws
  /// std::invalid_argument when a value is negative or not finite or the flux is not positive: whoever reads
  /// files checks first.
  std::uint32_t add(std::string_view name, const Photometry& photometry);

  std::vector<LightProfile> profiles;
  std::vector<float> data;

 private:
  std::vector<std::string> names_;
};

}  // namespace nightcity
