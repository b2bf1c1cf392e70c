// Elevation models in files, archives and gzip streams.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/terrain/elevation_model.h"

namespace nightcity::terrain {

struct ElevationOptions {
  int max_block_mpx = default_max_block_mpx;
  /// A limit: what all archives and gzip streams together unpack to, MB of the temporary folder.
  int max_unpacked_mb = 16'384;
  std::string crs_without;  // the CRS of rasters that name none; "": they stay without
};

/// About equally fine models, such as the tiles of one survey.
struct ResolutionClass {
  std::size_t begin = 0, end = 0;  // of the models, in the order of open_elevation_models
  double step_m = 0;               // least distance of neighbouring heights
};

/// Returns the classes of models, in any order, the finest class first.
std::vector<ResolutionClass> find_resolution_classes(std::span<const ElevationModel> models);

/// Opens rasters of heights: of a .zip all that are in it, with what belongs to them (.tfw, .prj,
/// .hdr, ...), of a .gz the one. They are unpacked into the temporary folder. Those that are
/// clearly finer come before others, else they have the order of the files. What an archive holds
/// beside is passed over, with a note on stderr where it might have been heights. Throws Error as
/// ElevationModel does; where an archive holds no raster, is broken or encrypted; where one unpacks
/// to more than its size allows, or all to more than `max_unpacked_mb`.
std::vector<ElevationModel> open_elevation_models(const std::vector<std::filesystem::path>& files,
                                                  const ElevationOptions& options);

}  // namespace nightcity::terrain
