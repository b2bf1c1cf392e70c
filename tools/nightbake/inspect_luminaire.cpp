#include <algorithm>

#include "tools/lights/luminaire.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {

Inspection inspect_luminaire(const std::filesystem::path& file) {
  const lights::Luminaire luminaire = lights::read_luminaire(file);
  Inspection result = make_empty_inspection("luminaire");
  result["lights"] = {{"luminaire", 1}};
  result["name"] = luminaire.name;
  result["manufacturer"] = luminaire.manufacturer;
  result["flux_lm"] = luminaire.flux_lm;
  if (luminaire.stated_flux_lm > 0)
    result["stated_flux_lm"] = luminaire.stated_flux_lm;
  else
    result["stated_flux_lm"] = nullptr;
  const lights::IntensityGrid& grid = luminaire.grid;
  const auto peak = std::max_element(grid.candela.begin(), grid.candela.end());
  const auto at = static_cast<std::size_t>(peak - grid.candela.begin());
  result["peak_cd"] = *peak;
  result["peak_c_degrees"] = grid.c_degrees[at / grid.gamma_degrees.size()];
  result["peak_gamma_degrees"] = grid.gamma_degrees[at % grid.gamma_degrees.size()];
  result["c_planes"] = grid.c_degrees.size();
  result["gamma_angles"] = grid.gamma_degrees.size();
  result["street_side_degrees"] = luminaire.street_side_degrees;
  // The distribution as city.lights will have it: the same flux on a regular grid.
  const lights::Photometry photometry = luminaire.photometry();
  result["resampled_flux_lm"] = lights::integrated_flux(photometry);
  if (!luminaire.notes.empty()) result["notes"] = luminaire.notes;
  result["opening_m"] = {luminaire.length_m, luminaire.width_m, luminaire.height_m};
  return result;
}

}  // namespace nightcity::nightbake
