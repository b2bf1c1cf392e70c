// The numbers of an ANSI/IES LM-63 file, which follow its TILT line.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "tools/lights/luminaire.h"
#include "tools/lights/text_lines.h"

namespace nightcity::lights {

/// Returns the year of LM-63 that a file names in its first line, in letters of either case:
/// "IES:LM-63-2019", "IESNA:LM-63-2002", "IESNA91". 1986 for a file that names none, because the first edition asked
/// for no such line.
int find_lm63_year(std::string_view first_line);

struct IesTable {
  int type = 1;  // 1 = C, 2 = B, 3 = A
  double stated_flux_lm = 0;
  double width_m = 0, length_m = 0, height_m = 0;  // luminous opening
  std::vector<double> vertical, horizontal;        // degrees, ascending
  std::vector<double> candela;                     // horizontal * vertical.size() + vertical
  std::size_t vertical_line = 0, horizontal_line = 0, last_line = 0;  // for messages
  bool has_text_after = false;  // words, but no numbers, after the table
};

/// Reads the numbers from line `first` (an index) to the end of the file. Line breaks mean nothing
/// there. A comma between two digits separates numbers or stands for the decimal point: only one of
/// the two gives the count of numbers that the file announces. Throws Error with the line: no
/// number, too few or too many of them, angles that do not ascend, negative candela.
IesTable read_ies_table(const TextLines& lines, std::size_t first, bool has_tilt_table, int year);

/// Returns the distribution over the whole turn: unfolds type C, which lists the planes of one
/// sector of symmetry, and resamples types A and B. Throws Error with the line of the angles that
/// do not fit.
IntensityGrid unfold_table(const TextLines& lines, const IesTable& table);

}  // namespace nightcity::lights
