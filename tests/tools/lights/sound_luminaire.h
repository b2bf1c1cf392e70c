// Checks that hold for every luminaire file, broken or not: for the
// fuzz target and the test of its corpus.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "formats/error.h"
#include "tools/lights/luminaire.h"

namespace nightcity::test {

/// Returns what is wrong with how the file is read; "" where it is sound, or refused with a reason.
inline std::string find_fault_of_luminaire(const std::filesystem::path& file) {
  using namespace lights;
  const auto is_light = [](double value) { return std::isfinite(value) && value >= 0; };
  try {
    const Luminaire luminaire = read_luminaire(file);
    if (!is_light(luminaire.flux_lm) || luminaire.flux_lm == 0) return "flux";
    if (!is_light(luminaire.stated_flux_lm)) return "stated flux";
    for (const double side : {luminaire.length_m, luminaire.width_m, luminaire.height_m})
      if (!is_light(side)) return "size";
    const IntensityGrid& grid = luminaire.grid;
    if (grid.candela.size() != grid.c_degrees.size() * grid.gamma_degrees.size()) return "grid";
    if (!std::all_of(grid.candela.begin(), grid.candela.end(), is_light)) return "candela";
    for (const auto* angles : {&grid.c_degrees, &grid.gamma_degrees})
      if (!std::is_sorted(angles->begin(), angles->end())) return "angles";
    const Photometry photometry = luminaire.photometry();
    if (photometry.values.size() != std::size_t{photometry.c_count} * photometry.gamma_count)
      return "photometry";
    ProfileTable table;  // which throws where a value is no light
    table.add("luminaire", photometry);
  } catch (const Error& error) {
    if (std::string(error.what()).empty()) return "an error without words";
  }
  return "";
}

}  // namespace nightcity::test
