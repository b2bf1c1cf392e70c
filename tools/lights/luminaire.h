// Measured luminaires: IES LM-63 and EULUMDAT files as light distributions for the light file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/lights/photometry.h"

namespace nightcity {

/// A measured distribution, unfolded to the whole turn: candela at every pair of angles, bilinear between.
/// C counts anticlockwise seen from above the luminaire, gamma from its photometric axis (nadir).
struct IntensityGrid {
  std::vector<double> c_degrees;  // ascending from 0; 360 stands for 0 again and is not listed
  std::vector<double>
      gamma_degrees;            // ascending within 0..180; outside their range there is no light
  std::vector<double> candela;  // c * gamma_degrees.size() + gamma
};

struct Luminaire {
  std::string name, manufacturer;
  IntensityGrid grid;
  double flux_lm = 0;              // out of the luminaire: integral of the grid
  double stated_flux_lm = 0;       // what the file says that should be; 0 = it does not say
  double street_side_degrees = 0;  // the C plane that faces the road, as guess_street_side finds it
  double length_m = 0, width_m = 0, height_m = 0;  // luminous opening; 0 = a point

  /// For a light: regular grid, C = 0 towards the street, turning as formats/light.h wants it. Exact where
  /// the file's angles are regular.
  Photometry photometry() const;
};

/// Bilinear; any C, gamma 0..180.
double intensity_at(const IntensityGrid& grid, double c_degrees, double gamma_degrees);

/// Lumens, in closed form for the bilinear interpolant.
double integrated_flux(const IntensityGrid& grid);

/// A road luminaire throws along the road to both sides, and more over the road than to the houses. The C
/// plane (0, 90, 180 or 270) that so faces the road; `usual` where the distribution does not tell.
double guess_street_side(const IntensityGrid& grid, double usual);

/// IES LM-63-1986 to 2019, photometric types A, B and C, absolute and relative. Throws Error with the line.
Luminaire read_ies(const std::filesystem::path& file);
/// EULUMDAT (.ldt), every symmetry. Throws Error with the line.
Luminaire read_eulumdat(const std::filesystem::path& file);
/// Either, by content: IES files hold a TILT line.
Luminaire read_luminaire(const std::filesystem::path& file);

}  // namespace nightcity
