#include "tools/terrain/elevation_model.h"

#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/input_file.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/gdal/utm_zone.h"
#include "tools/terrain/fill_value.h"
#include "tools/terrain/height_unit.h"
#include "tools/terrain/loose_points.h"
#include "tools/terrain/raster_checks.h"
#include "tools/terrain/raster_crs.h"
#include "tools/terrain/raster_formats.h"
#include "tools/terrain/raster_transform.h"

namespace nightcity::terrain {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

struct ElevationModel::State {
  std::string name;
  std::shared_ptr<const gdal::ScratchFiles> unpacked;  // which the dataset goes before
  GDALDatasetUniquePtr dataset;
  GDALRasterBand* band = nullptr;
  double to_pixel[6] = {};
  std::vector<GDALRasterBand*> masks;  // zero where there are no data
  bool has_text_rows = false;          // of which a row is found by those before it
  mutable int rows_passed = 0;         // of these
  bool in_degrees = false;
  double resolution = 0, scale = 1, offset = 0, no_data = nothing;
  double unit = 1;  // metres in the unit of heights; negative where they are depths
  std::string crs, assumption;
  std::unique_ptr<OGRCoordinateTransformation> transformation;

  // Returns pixel coordinates; (0, 0) is the first pixel's centre.
  glm::dvec2 to_pixels(const glm::dvec2& p) const {
    return {to_pixel[0] + to_pixel[1] * p.x + to_pixel[2] * p.y - 0.5,
            to_pixel[3] + to_pixel[4] * p.x + to_pixel[5] * p.y - 0.5};
  }

  // Returns whether a place lies more than so many pixels beyond the outermost centres.
  bool is_outside(const glm::dvec2& pixel, double margin = 0.5) const {
    return !(pixel.x >= -margin && pixel.y >= -margin && pixel.x <= band->GetXSize() - 1 + margin &&
             pixel.y <= band->GetYSize() - 1 + margin);
  }

  // Compares in the pixels' type: -3.4028235e38 is no double that a float can be equal to.
  bool is_no_data(double value) const {
    return value == no_data || (band->GetRasterDataType() == GDT_Float32 &&
                                static_cast<float>(value) == static_cast<float>(no_data));
  }

  void pass_rows(int end) const;
  void sample_pixels(std::span<const glm::dvec2> pixels, std::span<HeightSample> samples) const;
  glm::dvec2 find_pixel(const glm::dvec2& place) const;
};

// A raster in degrees may count its longitudes from 0 to 360.
glm::dvec2 ElevationModel::State::find_pixel(const glm::dvec2& place) const {
  const glm::dvec2 pixel = to_pixels(place);
  if (!in_degrees || !is_outside(pixel)) return pixel;
  for (const double turn : {360.0, -360.0})
    if (const glm::dvec2 turned = to_pixels(place + glm::dvec2(turn, 0)); !is_outside(turned))
      return turned;
  return pixel;
}

namespace {

RasterFile to_raster_file(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::string name = file.string();
  if (!std::filesystem::exists(file, ignored)) throw Error(name, "does not exist");
  if (std::filesystem::is_directory(file, ignored))
    throw Error(name, "is a folder: name the rasters in it");
  refuse_special_file(file);
  return {name, name, nullptr};
}

}  // namespace

ElevationModel::ElevationModel(const std::filesystem::path& file, int max_block_mpx,
                               const std::string& crs_without)
    : ElevationModel(to_raster_file(file), max_block_mpx, crs_without) {}

ElevationModel::ElevationModel(const RasterFile& file, int max_block_mpx,
                               const std::string& crs_without, const ElevationModel* like)
    : state_(std::make_unique<State>()) {
  gdal::register_drivers();
  const gdal::Guard guard;
  State& s = *state_;
  s.name = file.name;
  s.unpacked = file.unpacked;
  const std::string& path = file.path;
  if (const char* format = find_refused_format(path))
    throw Error(s.name, std::string("is of the raster format ") + format +
                            ", which is not read: it may lead to other files or to the network. "
                            "Name the rasters that it is made of, or write it as GeoTIFF "
                            "(gdal_translate)");
  CPLErrorReset();
  s.dataset.reset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, list_allowed_drivers()));
  if (!s.dataset && says_points_in_no_order()) s.dataset = grid_loose_points(path, s.name);
  if (!s.dataset || s.dataset->GetRasterCount() < 1)
    throw NoRaster(s.name, "is no raster of heights: " + explain_unread_raster(path));
  refuse_picture(*s.dataset, s.name);
  s.band = s.dataset->GetRasterBand(1);
  s.has_text_rows = has_text_rows(*s.dataset);
  s.masks = find_masks(*s.dataset, *s.band);
  for (int i = 1; i <= s.dataset->GetRasterCount(); ++i)
    refuse_large_blocks(*s.dataset->GetRasterBand(i), max_block_mpx, s.name);
  double from_pixel[6];
  find_raster_transform(*s.dataset, s.name, from_pixel);
  int said = 0;
  if (const double value = s.band->GetNoDataValue(&said); said) s.no_data = value;
  if (const double value = s.band->GetScale(&said); said && value != 0) s.scale = value;
  if (const double value = s.band->GetOffset(&said); said) s.offset = value;

  const auto found = find_raster_crs(*s.dataset, path, s.name, crs_without);
  const OGRSpatialReference* const crs = found ? &*found : nullptr;
  if (crs) from_pixel[0] = gdal::take_zone_off(from_pixel[0], crs->GetUTMZone(nullptr));
  if (!GDALInvGeoTransform(from_pixel, s.to_pixel))
    throw Error(s.name, "has a geotransform without extent: all of its pixels lie on a line");
  s.unit = find_height_unit(*s.band, crs, s.name);
  if (s.band->GetRasterDataType() == GDT_Byte && s.scale == 1)
    s.assumption = "heights of " + std::filesystem::path(s.name).filename().string() +
                   " taken as metres, although they are bytes (0 to 255), as a shaded relief has";
  if (assumes_metres(*s.band, crs))
    s.assumption = "heights of " + std::filesystem::path(s.name).filename().string() +
                   " taken as metres, of which its CRS, which counts feet, says nothing "
                   "(gdal_edit.py -units ft says that they are feet)";
  if (const int others = s.dataset->GetRasterCount() - 1 - count_alpha_bands(*s.dataset);
      others > 0 && s.assumption.empty())
    s.assumption = "heights of " + std::filesystem::path(s.name).filename().string() +
                   " taken from its first band, beside which it has " + std::to_string(others) +
                   " more (gdal_translate -b chooses one)";
  if (counts_downward(crs)) s.unit = -s.unit;

  double unit_m = 1;
  if (crs) {
    OGRSpatialReference raster(*crs), wgs84;
    wgs84.importFromEPSG(4326);
    raster.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    // PROJ looks into its database for each anew, which takes longer than all the rest.
    OGRCoordinateTransformation* const known = like ? like->state_->transformation.get() : nullptr;
    s.transformation.reset(known && raster.IsSame(known->GetTargetCS())
                               ? known->Clone()
                               : OGRCreateCoordinateTransformation(&wgs84, &raster));
    if (!s.transformation) throw Error(s.name, "its CRS cannot be used: " + gdal::find_reason());
    if (const char* code = crs->GetAuthorityCode(nullptr))
      s.crs = std::string(crs->GetAuthorityName(nullptr)) + ":" + code;
    constexpr double degree_m = 111'320;
    s.in_degrees = raster.IsGeographic();
    unit_m = raster.IsGeographic() ? degree_m : raster.GetLinearUnits();
  }
  s.resolution = std::hypot(from_pixel[2], from_pixel[5]) * unit_m;
  if (!(s.resolution > 0)) throw Error(s.name, "has pixels without extent");
}

ElevationModel::~ElevationModel() = default;
ElevationModel::ElevationModel(ElevationModel&&) noexcept = default;
ElevationModel& ElevationModel::operator=(ElevationModel&&) noexcept = default;

const std::string& ElevationModel::name() const {
  return state_->name;
}

bool ElevationModel::has_crs() const {
  return state_->transformation != nullptr;
}

const std::string& ElevationModel::crs() const {
  return state_->crs;
}

const std::string& ElevationModel::assumption() const {
  return state_->assumption;
}

double ElevationModel::resolution_m() const {
  return state_->resolution;
}

// Reads rows of text in order up to `end`. Where one is missing, GDAL 3.6 looks for each of the
// later ones by all between, which look for theirs: for 50 rows that a file lacks, without an end.
void ElevationModel::State::pass_rows(int end) const {
  if (!has_text_rows || rows_passed >= end) return;
  const int width = band->GetXSize();
  std::vector<double> row(static_cast<std::size_t>(width));
  for (; rows_passed < end; ++rows_passed)
    if (band->RasterIO(GF_Read, 0, rows_passed, width, 1, row.data(), width, 1, GDT_Float64, 0,
                       0) != CE_None)
      throw Error(name, "row " + std::to_string(rows_passed + 1) + " of " +
                            std::to_string(band->GetYSize()) + " cannot be read (" +
                            gdal::find_reason() + "): damaged or cut off; fetch it again");
}

// Reads the window around the pixels; where they lie far apart, half of them at a time.
void ElevationModel::State::sample_pixels(std::span<const glm::dvec2> pixels,
                                          std::span<HeightSample> samples) const {
  constexpr double max_window = 4e6, margin = 1;
  const int width = band->GetXSize(), height = band->GetYSize();
  const glm::dvec2 last(width - 1, height - 1);
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const glm::dvec2& p : pixels) {
    if (is_outside(p, margin)) continue;
    low = glm::min(low, glm::floor(glm::clamp(p, glm::dvec2(0), last)));
    high = glm::max(high, glm::ceil(glm::clamp(p, glm::dvec2(0), last)));
  }
  std::fill(samples.begin(), samples.end(), HeightSample());
  if (!(low.x <= high.x)) return;
  const glm::dvec2 extent = high - low + 1.0;
  if (extent.x * extent.y > max_window && pixels.size() > 1) {
    const std::size_t half = pixels.size() / 2;
    sample_pixels(pixels.first(half), samples.first(half));
    sample_pixels(pixels.subspan(half), samples.subspan(half));
    return;
  }
  const int columns = static_cast<int>(extent.x), rows = static_cast<int>(extent.y);
  pass_rows(static_cast<int>(low.y) + rows);
  std::vector<double> window(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (band->RasterIO(GF_Read, static_cast<int>(low.x), static_cast<int>(low.y), columns, rows,
                     window.data(), columns, rows, GDT_Float64, 0, 0) != CE_None)
    throw Error(name, "cannot be read: " + gdal::find_reason());
  std::vector<double> seen(window.size());
  for (GDALRasterBand* const mask : masks) {
    if (mask->RasterIO(GF_Read, static_cast<int>(low.x), static_cast<int>(low.y), columns, rows,
                       seen.data(), columns, rows, GDT_Float64, 0, 0) != CE_None)
      throw Error(name, "its mask cannot be read: " + gdal::find_reason());
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (seen[i] == 0) window[i] = nothing;
  }
  const GDALDataType type = band->GetRasterDataType();
  const auto value = [&](double x, double y) {
    const std::size_t at = static_cast<std::size_t>(y - low.y) * static_cast<std::size_t>(columns) +
                           static_cast<std::size_t>(x - low.x);
    if (is_no_data(window[at]) || is_end_of_type(window[at], type)) return nothing;
    const double metres = (window[at] * scale + offset) * unit;
    return is_fill_value(window[at], metres) ? nothing : metres;
  };
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (is_outside(pixels[i], margin)) continue;
    const glm::dvec2 p = glm::clamp(pixels[i], glm::dvec2(0), last), a = glm::floor(p),
                     b = glm::ceil(p), f = p - a, beyond = glm::abs(pixels[i] - p);
    // A weight of zero must not let a pixel without data in.
    const auto mix = [](double from, double to, double t) {
      return t == 0 ? from : from + t * (to - from);
    };
    const double upper = mix(value(a.x, a.y), value(b.x, a.y), f.x);
    samples[i] = {f.y == 0 ? upper : mix(upper, mix(value(a.x, b.y), value(b.x, b.y), f.x), f.y),
                  (1 - beyond.x) * (1 - beyond.y), !is_outside(pixels[i])};
  }
}

void ElevationModel::sample(std::span<const glm::dvec2> places, std::span<double> heights) const {
  std::vector<HeightSample> samples(places.size());
  sample_beyond(places, samples);
  for (std::size_t i = 0; i < samples.size(); ++i)
    heights[i] = samples[i].inside ? samples[i].height : nothing;
}

void ElevationModel::sample_beyond(std::span<const glm::dvec2> places,
                                   std::span<HeightSample> samples) const {
  const gdal::Guard guard;
  std::vector<double> x, y;
  for (const glm::dvec2& p : places) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  std::vector<int> placed(places.size(), 1);
  if (state_->transformation && !places.empty())
    state_->transformation->Transform(static_cast<int>(places.size()), x.data(), y.data(), nullptr,
                                      placed.data());
  std::vector<glm::dvec2> pixels;
  for (std::size_t i = 0; i < places.size(); ++i)
    pixels.push_back(placed[i] ? state_->find_pixel({x[i], y[i]}) : glm::dvec2(nothing));
  state_->sample_pixels(pixels, samples);
}

}  // namespace nightcity::terrain
