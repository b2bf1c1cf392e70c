// Checks that hold for every elevation model, broken or not: for the fuzz target and the test of
// its corpus.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "formats/error.h"
#include "tools/terrain/open_models.h"
#include "tools/terrain/raster_names.h"

namespace nightcity::test {

/// Returns a name for a file of these bytes: GDAL knows some formats by the ending as well, and
/// texts and grids of GSI are put into another form by theirs.
inline const char* name_raster(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04")) return "dem.zip";
  if (bytes.starts_with("\x1f\x8b")) return "dem.xyz.gz";
  if (bytes.starts_with("<?xml")) return "FG-GML-5339-45-DEM5A.xml";
  if (bytes.starts_with('#') || bytes.starts_with("\xff\xfe")) return "dem.xyz";
  if (bytes.starts_with("HF2")) return "dem.hf2";
  if (bytes.starts_with("binterr")) return "dem.bt";
  return "dem.tif";
}

/// Returns places to ask an elevation model for: of the corpus's rasters, and all over the world.
inline std::vector<std::vector<glm::dvec2>> list_places() {
  std::vector<std::vector<glm::dvec2>> lists(2);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      lists[0].emplace_back(13.4 + 0.0011 * i, 52.5 - 0.0007 * j);
      lists[1].emplace_back(391'000 + 9.5 * i, 5'819'000 - 7.25 * j);
    }
  for (int i = -4; i <= 4; ++i)
    for (int j = -2; j <= 2; ++j) lists.push_back({{44.9 * i, 44.9 * j}});
  return lists;
}

/// Returns what is wrong with how the raster is read; "" where it is sound, or refused with a
/// reason.
inline std::string find_fault_of_raster(const std::filesystem::path& path) {
  try {
    terrain::ElevationOptions options;
    options.max_block_mpx = 1;  // blocks are unpacked as a whole
    options.max_unpacked_mb = 2;
    for (const terrain::ElevationModel& model :
         terrain::open_elevation_models(terrain::list_raster_files(path), options)) {
      if (!(model.resolution_m() > 0)) return "resolution";
      for (const auto& places : list_places()) {
        std::vector<double> heights(places.size());
        model.sample(places, heights);
        for (const double height : heights)
          if (!std::isnan(height) && !(height > -9'900 && height < 9'000)) return "height";
      }
    }
  } catch (const Error& error) {
    if (std::string(error.what()).empty()) return "an error without words";
  }
  return "";
}

}  // namespace nightcity::test
