// Small rasters whose every height is known.
#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <filesystem>
#include <functional>
#include <stdexcept>

namespace nightcity::test {

/// A GeoTIFF of doubles: `height` of column and row, cells of `step` from the north-west corner (x,
/// y).
inline void write_raster(const std::filesystem::path& path, int epsg, double x, double y,
                         double step, int columns, int rows,
                         const std::function<double(int, int)>& height, double no_data) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDatasetUniquePtr data(driver->Create(path.c_str(), columns, rows, 1, GDT_Float64, nullptr));
  if (!data) throw std::runtime_error("no raster");
  double transform[6] = {x, step, 0, y, 0, -step};
  data->SetGeoTransform(transform);
  if (epsg) {
    OGRSpatialReference crs;
    crs.importFromEPSG(epsg);
    data->SetSpatialRef(&crs);
  }
  data->GetRasterBand(1)->SetNoDataValue(no_data);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      double value = height(column, row);
      if (data->GetRasterBand(1)->RasterIO(GF_Write, column, row, 1, 1, &value, 1, 1, GDT_Float64,
                                           0, 0) != CE_None)
        throw std::runtime_error("no cell");
    }
}

}  // namespace nightcity::test
