#include "tools/elevation/dem_raster.h"

#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "formats/error.h"
#include "tools/terrain/raster_names.h"
#include "tools/terrain/sample_models.h"

namespace nightcity::elevation {

DemRaster::DemRaster(const std::filesystem::path& file, const terrain::ElevationOptions& options)
    : models_(terrain::open_elevation_models(terrain::list_raster_files(file), options)) {
  for (const terrain::ElevationModel& model : models_)
    if (!model.has_crs())
      throw Error(model.name(),
                  "names no coordinate reference system: say it by --dem-crs (\"EPSG:25832\")");
  constexpr std::size_t most_named = 3;
  std::size_t assumed = 0;
  for (const terrain::ElevationModel& model : models_)
    if (const std::string& said = model.assumption(); !said.empty() && assumed++ < most_named)
      std::fprintf(stderr, "note: %s\n", said.c_str());
  if (assumed > most_named)
    std::fprintf(stderr, "note: and so of %zu other rasters\n", assumed - most_named);
}

std::optional<double> DemRaster::height_at(const glm::dvec2& lon_lat) const {
  const std::span place(&lon_lat, 1);
  double height = 0;
  terrain::sample_models(models_, place, place, std::span(&height, 1));
  return std::isnan(height) ? std::nullopt : std::optional(height);
}

}  // namespace nightcity::elevation
