// Rasters whose heights are a plane: bilinear interpolation must give the plane back.
#include "tools/terrain/elevation_model.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <vector>

#include "formats/error.h"
#include "support/data.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

using test::TempFolder;

struct Raster {
  double west, north, step;
  int width, height;
  int epsg;  // 0 = none
};

double plane(double x, double y) {
  return 30 + 0.01 * x - 0.02 * y;
}

/// Height `plane(x - west, y - north)` at each pixel's centre; -9999 where `hole` says so.
template <class Hole>
void write_raster(const std::filesystem::path& path, const Raster& r, const Hole& hole) {
  GDALAllRegister();
  GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), r.width, r.height, 1, GDT_Float64, nullptr));
  ASSERT_TRUE(set);
  double transform[6] = {r.west, r.step, 0, r.north, 0, -r.step};
  set->SetGeoTransform(transform);
  if (r.epsg) {
    OGRSpatialReference crs;
    crs.importFromEPSG(r.epsg);
    set->SetSpatialRef(&crs);
  }
  std::vector<double> values;
  for (int j = 0; j < r.height; ++j)
    for (int i = 0; i < r.width; ++i)
      values.push_back(hole(i, j) ? -9999 : plane((i + 0.5) * r.step, -(j + 0.5) * r.step));
  set->GetRasterBand(1)->SetNoDataValue(-9999);
  ASSERT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, r.width, r.height, values.data(),
                                            r.width, r.height, GDT_Float64, 0, 0),
            CE_None);
}

const auto whole = [](int, int) { return false; };

std::vector<double> sample(const ElevationModel& model, const std::vector<glm::dvec2>& places) {
  std::vector<double> heights(places.size());
  model.sample(places, heights);
  return heights;
}

TEST(ElevationModel, GivesAPlaneBackBetweenThePixelsCentres) {
  const TempFolder folder;
  write_raster(folder / "plane.tif", {391000, 5819100, 10, 40, 30, 0}, whole);
  const ElevationModel model(folder / "plane.tif");
  EXPECT_FALSE(model.has_crs());
  EXPECT_EQ(model.resolution_m(), 10);
  std::vector<glm::dvec2> places;
  for (double x = 5; x <= 395; x += 6.5)
    for (double y = -5; y >= -295; y -= 7.25) places.emplace_back(391000 + x, 5819100 + y);
  const std::vector<double> heights = sample(model, places);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(heights[i], plane(places[i].x - 391000, places[i].y - 5819100), 1e-6);
  EXPECT_TRUE(std::isnan(sample(model, {{390999, 5819000}})[0]));
  EXPECT_TRUE(std::isnan(sample(model, {{std::nan(""), 5819000}})[0]));
}

TEST(ElevationModel, GoesThroughItsOwnCrs) {
  const TempFolder folder;
  write_raster(folder / "degrees.tif", {13.39, 52.52, 0.001, 20, 20, 4326}, whole);
  const ElevationModel degrees(folder / "degrees.tif");
  EXPECT_TRUE(degrees.has_crs());
  EXPECT_NEAR(degrees.resolution_m(), 111.3, 0.5);
  EXPECT_NEAR(sample(degrees, {{13.4, 52.51}})[0], plane(0.01, -0.01), 1e-9);
  // The middle of zone 33, 15 degrees east, is easting 500000; the equator is northing 0.
  write_raster(folder / "utm.tif", {499000, 1000, 10, 200, 200, 25833}, whole);
  const ElevationModel utm(folder / "utm.tif");
  EXPECT_NEAR(sample(utm, {{15.0, 0.0}})[0], plane(1000, -1000), 1e-6);
}

TEST(ElevationModel, BesidePixelsWithoutDataThereIsNothing) {
  const TempFolder folder;
  write_raster(folder / "hole.tif", {0, 100, 10, 10, 10, 0},
               [](int i, int j) { return i == 4 && j == 4; });
  const ElevationModel model(folder / "hole.tif");
  EXPECT_TRUE(std::isnan(sample(model, {{45, 55}})[0]));
  EXPECT_TRUE(std::isnan(sample(model, {{40, 55}})[0]))
      << "between a pixel with data and one without";
  EXPECT_NEAR(sample(model, {{35, 55}})[0], plane(35, -45), 1e-9)
      << "on a centre its neighbours do not count";
}

TEST(ElevationModel, PlacesFarApartAreReadWithoutTheWorldBetween) {
  const TempFolder folder;
  write_raster(folder / "wide.tif", {0, 3000, 1, 3000, 3000, 0}, whole);
  const ElevationModel model(folder / "wide.tif");
  const std::vector<double> heights = sample(model, {{1, 2999}, {2999, 1}, {1.5, 2998.5}});
  EXPECT_NEAR(heights[0], plane(1, -1), 1e-6);
  EXPECT_NEAR(heights[1], plane(2999, -2999), 1e-6);
}

TEST(ElevationModel, RefusesWhatIsNoRaster) {
  const TempFolder folder;
  test::write_text(folder / "text.tif", "heights");
  EXPECT_THROW(ElevationModel(folder / "text.tif"), Error);
  EXPECT_THROW(ElevationModel(folder / "absent.tif"), Error);
}

TEST(ElevationModel, ReadsASrtmTile) {
  REAL_DATA(file, "dem/N49E011.hgt.zip");
  const ElevationModel model(file);
  EXPECT_TRUE(model.has_crs());
  // Bayreuth's market place lies at some 340 m.
  EXPECT_NEAR(sample(model, {{11.5753, 49.9440}})[0], 345, 15);
}

}  // namespace
}  // namespace nightcity
