#include "tools/bake/city/ground_heights.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "formats/error.h"
#include "tools/terrain/open_models.h"
#include "tools/terrain/sample_models.h"

namespace nightcity::bake {
GroundHeights::GroundHeights(const GroundOptions& options, const georeference::CityFrame& city)
    : city_(city) {
  models_ = terrain::open_elevation_models(
      options.elevation_models,
      {options.max_dem_block_mpx, options.max_dem_unpacked_mb, options.elevation_crs});
  constexpr const char* remedy =
      "say its CRS by [terrain] dem_crs, or write it into it (gdal_edit.py -a_srs EPSG:<code>) "
      "or into a .prj beside it";
  std::size_t assumed = 0;
  constexpr std::size_t most_named = 3;
  for (const terrain::ElevationModel& model : models_) {
    if (model.has_crs() && !city_.has_lon_lat())
      throw Error(model.name(), "cannot be placed under a city that names no CRS: set [city] crs");
    if (!model.has_crs() && options.carries_buildings)
      throw Error(model.name(),
                  std::string("names no CRS, and cannot be placed under a map: ") + remedy);
    if (!model.has_crs())
      unplaced_ = std::filesystem::path(model.name()).filename().string() +
                  " names no CRS and is taken to have the city's: " + remedy;
    if (const std::string& said = model.assumption(); !said.empty() && assumed++ < most_named)
      assumptions_ += ", " + said;
  }
  for (const terrain::ResolutionClass& each : terrain::find_resolution_classes(models_))
    kinds_.push_back({each});
  if (!kinds_.empty()) finest_ = kinds_.front().step_m;
  if (assumed > most_named)
    assumptions_ += ", and those of " + std::to_string(assumed - most_named) + " others";
}

std::vector<double> GroundHeights::read(std::span<const glm::dvec2> places,
                                        std::span<const Kind> kinds) const {
  const std::lock_guard lock(mutex_);
  std::vector<double> heights(places.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::size_t> open(places.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (const Kind& kind : kinds) {
    if (open.empty()) break;
    const std::span models = std::span(models_).subspan(kind.begin, kind.end - kind.begin);
    const bool has_crs = std::any_of(models.begin(), models.end(),
                                     [](const auto& model) { return model.has_crs(); });
    std::vector<glm::dvec2> asked, lon_lat;
    for (const std::size_t i : open) asked.push_back(places[i]);
    if (has_crs)
      for (const glm::dvec2& p : asked) lon_lat.push_back(city_.to_lon_lat(p));
    std::vector<double> found(open.size());
    terrain::sample_models(models, asked, lon_lat, found);
    for (std::size_t k = 0; k < open.size(); ++k) heights[open[k]] = found[k] + kind.shift_m;
    std::erase_if(open, [&](std::size_t i) { return !std::isnan(heights[i]); });
  }
  return heights;
}

double GroundHeights::near(const glm::dvec2& place) const {
  constexpr double farthest_m = 5'000;
  constexpr int directions = 16;
  if (const double height = at({&place, 1}).front(); std::isfinite(height)) return height;
  for (double radius = finest_; radius < farthest_m; radius *= 2) {
    std::vector<glm::dvec2> circle;
    for (int k = 0; k < directions; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / directions;
      circle.push_back(place + radius * glm::dvec2(std::sin(azimuth), std::cos(azimuth)));
    }
    for (const double height : at(circle))
      if (std::isfinite(height)) return height;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace nightcity::bake
