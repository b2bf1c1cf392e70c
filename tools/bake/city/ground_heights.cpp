#include "tools/bake/city/ground_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "formats/error.h"

namespace nightcity::bake {
namespace {

using terrain::ElevationModel;

// Puts models that are clearly finer before others. Tiles of one survey in two CRSs are not equally
// fine to the last digit, and keep their order.
void put_finest_first(std::vector<ElevationModel>& models) {
  constexpr double clearly = 1.5;
  std::vector<double> steps;
  for (const ElevationModel& model : models) steps.push_back(model.resolution_m());
  std::sort(steps.begin(), steps.end());
  std::vector<double> classes;  // the finest of each
  for (const double step : steps)
    if (classes.empty() || step > clearly * classes.back()) classes.push_back(step);
  const auto class_of = [&](const ElevationModel& model) {
    return std::upper_bound(classes.begin(), classes.end(), model.resolution_m());
  };
  std::stable_sort(
      models.begin(), models.end(),
      [&](const ElevationModel& a, const ElevationModel& b) { return class_of(a) < class_of(b); });
}

}  // namespace

GroundHeights::GroundHeights(const GroundOptions& options, const georeference::CityFrame& city)
    : city_(city) {
  for (const auto& file : options.elevation_models) {
    models_.emplace_back(file, options.max_dem_block_mpx, options.elevation_crs);
    if (models_.back().has_crs() && !city_.has_lon_lat())
      throw Error(file.string(), "cannot be placed under a city that names no CRS: set [city] crs");
    constexpr const char* remedy =
        "say its CRS by [terrain] dem_crs, or write it into it (gdal_edit.py -a_srs EPSG:<code>) "
        "or into a .prj beside it";
    if (!models_.back().has_crs() && options.carries_buildings)
      throw Error(file.string(),
                  std::string("names no CRS, and cannot be placed under a map: ") + remedy);
    if (!models_.back().has_crs())
      unplaced_ =
          file.filename().string() + " names no CRS and is taken to have the city's: " + remedy;
    if (const std::string& said = models_.back().assumption(); !said.empty())
      assumptions_ += ", " + said;
    finest_ = std::min(finest_, models_.back().resolution_m());
  }
  put_finest_first(models_);
}

std::vector<double> GroundHeights::at(std::span<const glm::dvec2> places) const {
  const std::lock_guard lock(mutex_);
  std::vector<double> heights(places.size(), std::numeric_limits<double>::quiet_NaN()),
      next(places.size());
  std::vector<glm::dvec2> lon_lat;
  for (const terrain::ElevationModel& model : models_) {
    if (std::none_of(heights.begin(), heights.end(), [](double h) { return std::isnan(h); })) break;
    if (model.has_crs() && lon_lat.empty())
      for (const glm::dvec2& p : places) lon_lat.push_back(city_.to_lon_lat(p));
    model.sample(model.has_crs() ? std::span<const glm::dvec2>(lon_lat) : places, next);
    for (std::size_t i = 0; i < heights.size(); ++i)
      if (std::isnan(heights[i])) heights[i] = next[i];
  }
  return heights;
}

}  // namespace nightcity::bake
