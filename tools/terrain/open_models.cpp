#include "tools/terrain/open_models.h"

#include <algorithm>
#include <cstdio>

#include "formats/error.h"
#include "tools/terrain/packed_rasters.h"
#include "tools/terrain/raster_names.h"

namespace nightcity::terrain {
namespace {

// Puts models that are clearly finer before others. Tiles of one survey in two CRSs are not equally
// fine to the last digit, and keep their order.
void put_finest_first(std::vector<ElevationModel>& models) {
  const std::vector<ResolutionClass> classes = find_resolution_classes(models);
  const auto class_of = [&](const ElevationModel& model) {
    return std::upper_bound(
        classes.begin(), classes.end(), model.resolution_m(),
        [](double step_m, const ResolutionClass& each) { return step_m < each.step_m; });
  };
  std::stable_sort(
      models.begin(), models.end(),
      [&](const ElevationModel& a, const ElevationModel& b) { return class_of(a) < class_of(b); });
}

// Opens the rasters of one file. Texts in archives may be a licence or a list of tiles.
void open_rasters(const std::vector<RasterFile>& rasters, const ElevationOptions& options,
                  std::vector<ElevationModel>& models) {
  std::size_t passed_over = 0;
  std::string first, why;
  const std::size_t before = models.size();
  for (const RasterFile& raster : rasters) {
    try {
      models.emplace_back(raster, options.max_block_mpx, options.crs_without,
                          models.empty() ? nullptr : &models.back());
    } catch (const NoRaster& error) {
      if (!raster.unpacked || !is_named_as_text(raster.path)) throw;
      if (passed_over++ == 0) first = raster.name, why = error.what();
    }
  }
  if (passed_over == 0) return;
  if (models.size() == before) throw NoRaster("", why);
  std::fprintf(stderr, "note: %s: is no table of heights and was passed over%s\n", first.c_str(),
               passed_over == 1
                   ? ""
                   : (", and " + std::to_string(passed_over - 1) + " texts beside it").c_str());
}

}  // namespace

std::vector<ResolutionClass> find_resolution_classes(std::span<const ElevationModel> models) {
  constexpr double clearly_coarser = 1.5;
  std::vector<double> steps_m;
  for (const ElevationModel& model : models) steps_m.push_back(model.resolution_m());
  std::sort(steps_m.begin(), steps_m.end());
  std::vector<ResolutionClass> classes;
  for (std::size_t i = 0; i < steps_m.size(); ++i) {
    if (classes.empty() || steps_m[i] > clearly_coarser * classes.back().step_m)
      classes.push_back({i, i, steps_m[i]});
    classes.back().end = i + 1;
  }
  return classes;
}

std::vector<ElevationModel> open_elevation_models(const std::vector<std::filesystem::path>& files,
                                                  const ElevationOptions& options) {
  RasterUnpacker unpacker(options.max_unpacked_mb);
  // All are unpacked before the first is read: they share one file.
  std::vector<std::vector<RasterFile>> rasters;
  for (const auto& file : files) rasters.push_back(unpacker.find_rasters(file));
  std::vector<ElevationModel> models;
  for (const auto& of_file : rasters) open_rasters(of_file, options, models);
  put_finest_first(models);
  return models;
}

}  // namespace nightcity::terrain
