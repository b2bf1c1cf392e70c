// Rasters that hold planes: bilinear sampling must return them everywhere.
#include "tools/elevation/dem_raster.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/elevation/rasters.h"

namespace nightcity::elevation {
namespace {

TEST(DemRaster, APlaneIsMetEverywhereInside) {
  const test::TempFolder folder;
  // Middles of cells at 13.0005 + 0.001 column, 52.9995 - 0.001 row.
  test::write_raster(
      folder / "plane.tif", 4326, 13, 53, 0.001, 20, 10,
      [](int column, int row) { return 40 + 2.0 * column - 3.0 * row; }, -9999);
  const DemRaster raster(folder / "plane.tif");
  for (const double lon : {13.0005, 13.0049, 13.0123, 13.0195})
    for (const double lat : {52.9995, 52.9951, 52.9905}) {
      const auto height = raster.height_at({lon, lat});
      ASSERT_TRUE(height);
      EXPECT_NEAR(*height, 40 + 2 * (lon - 13.0005) * 1000 - 3 * (52.9995 - lat) * 1000, 1e-6);
    }
  EXPECT_NEAR(raster.height_at({13.0001, 52.9999}).value(), 40, 1e-9);  // the outer half of a cell
  for (const glm::dvec2 outside :
       {glm::dvec2(12.99, 52.995), glm::dvec2(13.01, 53.01), glm::dvec2(13.021, 52.995)})
    EXPECT_FALSE(raster.height_at(outside));
  EXPECT_FALSE(raster.height_at({1e9, 52.995}));
}

TEST(DemRaster, CellsWithoutDataGiveNothing) {
  const test::TempFolder folder;
  test::write_raster(
      folder / "hole.tif", 4326, 13, 53, 0.001, 4, 4,
      [](int column, int row) {
        if (column == 1 && row == 1) return -9999.0;
        return column == 3 && row == 3 ? 3.4e38 : 50.0;
      },
      -9999);
  const DemRaster raster(folder / "hole.tif");
  EXPECT_FALSE(raster.height_at({13.0015, 52.9985}));
  EXPECT_FALSE(raster.height_at({13.0010, 52.9985}));  // half of it
  EXPECT_FALSE(raster.height_at({13.0035, 52.9965}));  // a fill value that is not declared
  EXPECT_NEAR(raster.height_at({13.0025, 52.9975}).value(), 50, 1e-9);
}

TEST(DemRaster, ProjectedRastersAreFoundByLongitudeAndLatitude) {
  const test::TempFolder folder;
  // EPSG:25833: (391020, 5819010) is 13.394162598 east, 52.510303463 north.
  test::write_raster(
      folder / "utm.tif", 25833, 391000, 5819100, 10, 20, 20,
      [](int column, int) { return 10.0 * column + 5; }, -1);
  const auto height = DemRaster(folder / "utm.tif").height_at({13.394162598, 52.510303463});
  ASSERT_TRUE(height);
  EXPECT_NEAR(*height, 20, 0.01);  // easting - 391000
}

TEST(DemRaster, WhatIsAssumedOfHeightsIsSaid) {
  const test::TempFolder folder;
  const auto said_of = [&](int epsg) {
    test::write_raster(
        folder / "dem.tif", epsg, 300000, 60000, 10, 4, 4, [](int, int) { return 5.0; }, -1);
    testing::internal::CaptureStderr();
    const DemRaster raster(folder / "dem.tif");
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_NE(said_of(2263).find("note: heights of dem.tif taken as metres"), std::string::npos);
  EXPECT_EQ(said_of(25833), "");
}

TEST(DemRaster, ARasterWithoutACrsHasTheOneGiven) {
  const test::TempFolder folder;
  test::write_raster(
      folder / "utm.tif", 0, 391000, 5819100, 10, 20, 20,
      [](int column, int) { return 10.0 * column + 5; }, -1);
  const DemRaster raster(folder / "utm.tif", {.crs_without = "EPSG:25833"});
  EXPECT_NEAR(raster.height_at({13.394162598, 52.510303463}).value(), 20, 0.01);
  try {
    const DemRaster none(folder / "utm.tif");
    FAIL() << "was placed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--dem-crs"), std::string::npos) << error.what();
  }
}

TEST(DemRaster, WhatIsNoRasterIsAnErrorThatNamesIt) {
  const test::TempFolder folder;
  test::write_text(folder / "text.tif", "no raster");
  test::write_raster(
      folder / "nowhere.tif", 0, 0, 0, 1, 2, 2, [](int, int) { return 1.0; }, -1);
  for (const char* name : {"absent.tif", "text.tif", "nowhere.tif"}) {
    try {
      DemRaster raster(folder / name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace nightcity::elevation
