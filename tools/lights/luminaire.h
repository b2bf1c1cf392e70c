// Reads measured luminaires, IES LM-63, EULUMDAT and TM-33 files, as light distributions for the
// light file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/lights/photometry.h"

namespace nightcity::lights {

class TextLines;

/// A measured distribution, unfolded to the whole turn: candela at every pair of angles,
/// bilinear in between. C counts anticlockwise seen from above the luminaire, gamma from its
/// photometric axis (nadir).
struct IntensityGrid {
  std::vector<double> c_degrees;  // ascending from 0; 360 stands for 0 again and is not listed
  // Ascending within 0..180. Outside their range there is no light.
  std::vector<double> gamma_degrees;
  std::vector<double> candela;  // c * gamma_degrees.size() + gamma
};

struct Luminaire {
  std::string name, manufacturer;
  IntensityGrid grid;
  double flux_lm = 0;              // out of the luminaire: integral of the grid
  double stated_flux_lm = 0;       // the flux by the file's own statement; 0: it has none
  double street_side_degrees = 0;  // the C plane that faces the road, by guess_street_side
  double length_m = 0, width_m = 0, height_m = 0;  // luminous opening; 0: a point
  std::vector<std::string> notes;                  // what the file names and is not used

  /// Returns the distribution for a light: on a regular grid, with C = 0 towards the street and C
  /// turning as in formats/light.h. Exact if the file's angles are regular. It ends at the file's
  /// last gamma angle, so nothing shines beyond.
  Photometry photometry() const;
};

/// Returns the bilinear interpolant in candela; any C, gamma from 0 to 180.
double intensity_at(const IntensityGrid& grid, double c_degrees, double gamma_degrees);

/// Returns the flux in lumens, in closed form for the bilinear interpolant.
double integrated_flux(const IntensityGrid& grid);

/// Returns the C plane (0, 90, 180 or 270) that faces the road; `usual` if the distribution does
/// not show it. A road luminaire throws light along the road to both sides, and more over the road
/// than towards the houses.
double guess_street_side(const IntensityGrid& grid, double usual);

/// Returns whether this is the line that every IES file has before its numbers: "TILT=NONE",
/// "tilt = include", "TILT=lamp.tlt".
bool is_tilt_line(std::string_view line);

/// Returns whether the beginning of a text is that of an IES file: it holds the mark of an edition
/// of LM-63, or a TILT line.
bool begins_as_ies(std::string_view text);
/// Returns whether the first lines of a text have the numbers that EULUMDAT puts there: type,
/// symmetry, and how many C planes and gamma angles there are. The format has no mark.
bool begins_as_eulumdat(std::string_view text);

/// Returns whether the root of an XML document is that of TM-33 (LuminaireOpticalData, IESTM33-22).
bool begins_as_tm33(std::string_view text);

/// Reads IES LM-63-1986 to 2019, photometric types A, B and C, absolute and relative. Throws Error
/// with the line.
Luminaire read_ies(const TextLines& lines);
Luminaire read_ies(const std::filesystem::path& file);
/// Reads EULUMDAT (.ldt) with any symmetry. Throws Error with the line.
Luminaire read_eulumdat(const TextLines& lines);
Luminaire read_eulumdat(const std::filesystem::path& file);
/// Reads ANSI/IES TM-33-18 or -22 (XML) with luminous intensities of any type. Throws Error with
/// the line.
Luminaire read_tm33(const TextLines& lines);
/// Reads a GLDF container (a .zip with a product.xml that names files of photometry): the first
/// photometry that it defines, which a note says where there are several. Of other archives it
/// reads the only photometry, of a stream what it holds.
Luminaire read_packed_luminaire(const std::filesystem::path& file);
/// Reads any of the first three, by content: IES files hold a TILT line.
Luminaire read_luminaire(const TextLines& lines);
/// Reads any of them, by content.
Luminaire read_luminaire(const std::filesystem::path& file);

}  // namespace nightcity::lights
