#include "tools/elevation/dem_raster.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "formats/error.h"

namespace nightcity {

struct DemRaster::State {
  GDALDatasetUniquePtr data;
  std::unique_ptr<OGRCoordinateTransformation> to_raster;
  std::array<double, 6> to_cell{};  // affine, raster CRS to columns and rows
  std::optional<double> no_data;
  int columns = 0, rows = 0;
  double scale = 1, offset = 0;

  /// Height of a cell; nothing where it holds none.
  std::optional<double> cell(int column, int row) const {
    double value = 0;
    if (data->GetRasterBand(1)->RasterIO(GF_Read, column, row, 1, 1, &value, 1, 1, GDT_Float64, 0, 0) !=
        CE_None)
      return std::nullopt;
    if (!std::isfinite(value) || (no_data && value == *no_data)) return std::nullopt;
    const double height = value * scale + offset;
    if (!(height > -12'000 && height < 9'000)) return std::nullopt;  // fill values that are not declared
    return height;
  }
};

DemRaster::DemRaster(const std::filesystem::path& file) : state_(std::make_unique<State>()) {
  static std::once_flag drivers;
  std::call_once(drivers, GDALAllRegister);
  State& state = *state_;
  CPLPushErrorHandler(CPLQuietErrorHandler);  // what went wrong is in our own message
  state.data.reset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  const std::string reason = CPLGetLastErrorMsg();
  CPLPopErrorHandler();
  if (!state.data) throw Error(file.string(), "is no raster that GDAL reads: " + reason);
  if (state.data->GetRasterCount() < 1) throw Error(file.string(), "has no band");
  std::array<double, 6> from_cell{};
  if (state.data->GetGeoTransform(from_cell.data()) != CE_None ||
      !GDALInvGeoTransform(from_cell.data(), state.to_cell.data()))
    throw Error(file.string(), "does not say where it lies");
  const OGRSpatialReference* crs = state.data->GetSpatialRef();
  if (!crs) throw Error(file.string(), "names no coordinate reference system");
  OGRSpatialReference source, target(*crs);
  source.importFromEPSG(4326);
  source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  state.to_raster.reset(OGRCreateCoordinateTransformation(&source, &target));
  if (!state.to_raster) throw Error(file.string(), "lies in a coordinate reference system PROJ cannot reach");
  GDALRasterBand* band = state.data->GetRasterBand(1);
  int given = 0;
  const double no_data = band->GetNoDataValue(&given);
  if (given) state.no_data = no_data;
  const double scale = band->GetScale(&given);
  if (given && scale != 0) state.scale = scale;
  const double offset = band->GetOffset(&given);
  if (given) state.offset = offset;
  state.columns = state.data->GetRasterXSize();
  state.rows = state.data->GetRasterYSize();
}

DemRaster::~DemRaster() = default;
DemRaster::DemRaster(DemRaster&&) noexcept = default;
DemRaster& DemRaster::operator=(DemRaster&&) noexcept = default;

std::optional<double> DemRaster::height_at(const glm::dvec2& lon_lat) const {
  const State& state = *state_;
  double x = lon_lat.x, y = lon_lat.y;
  if (!state.to_raster->Transform(1, &x, &y) || !std::isfinite(x + y)) return std::nullopt;
  const auto& m = state.to_cell;
  const double column = m[0] + m[1] * x + m[2] * y, row = m[3] + m[4] * x + m[5] * y;
  if (!(column >= 0 && column <= state.columns && row >= 0 && row <= state.rows)) return std::nullopt;
  // Values belong to the middles of cells; the outer half cells keep their own.
  const double u = std::clamp(column - 0.5, 0.0, state.columns - 1.0),
               v = std::clamp(row - 0.5, 0.0, state.rows - 1.0);
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  double height = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const double weight = (i ? u - left : 1 - (u - left)) * (j ? v - top : 1 - (v - top));
      if (weight == 0) continue;
      const auto corner = state.cell(left + i, top + j);
      if (!corner) return std::nullopt;
      height += weight * *corner;
    }
  return height;
}

}  // namespace nightcity
