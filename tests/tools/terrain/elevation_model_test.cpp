// Rasters whose heights are a plane: bilinear interpolation must give the plane back.
#include "tools/terrain/elevation_model.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <sys/stat.h>

#include <cerrno>
#include <cmath>
#include <vector>

#include "formats/error.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/terrain/sample_models.h"

namespace nightcity::terrain {
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

TEST(SampleModels, TilesGiveWhatOneRasterGives) {
  const TempFolder folder;
  // Four tiles of pixels of 10 m that meet at 120 m east, 90 m south, cut out of one surface.
  const auto bumps = [](double x, double y) {
    return 30 + 5 * std::sin(x / 15) * std::cos(y / 20);
  };
  std::vector<ElevationModel> models;
  const auto add = [&](const char* name, int left, int top, int right, int bottom) {
    const Raster r{391000.0 + 10 * left, 5819100.0 - 10 * top, 10, right - left, bottom - top, 0};
    write_raster(folder / name, r, whole);
    GDALDatasetUniquePtr set(
        GDALDataset::Open((folder / name).c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    std::vector<double> values;
    for (int j = top; j < bottom; ++j)
      for (int i = left; i < right; ++i) values.push_back(bumps(10 * i + 5, 10 * j + 5));
    ASSERT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, r.width, r.height, values.data(),
                                              r.width, r.height, GDT_Float64, 0, 0),
              CE_None);
    set.reset();
    models.emplace_back(folder / name);
  };
  add("one.tif", 0, 0, 30, 20);
  add("a.tif", 0, 0, 12, 9);
  add("b.tif", 12, 0, 30, 9);
  add("c.tif", 0, 9, 12, 20);
  add("d.tif", 12, 9, 30, 20);
  add("wide.tif", 8, 0, 30, 20);  // overlaps a and c
  std::vector<glm::dvec2> places;
  for (double x = 0; x <= 300; x += 1.25)
    for (double y = 0; y <= 200; y += 1.25) places.emplace_back(391000 + x, 5819100 - y);
  const auto ask = [&](std::size_t first, std::size_t count) {
    std::vector<double> heights(places.size());
    sample_models(std::span(models).subspan(first, count), places, places, heights);
    return heights;
  };
  const std::vector<double> one = ask(0, 1), four = ask(1, 4), overlapping = ask(3, 3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(four[i], one[i], 1e-9) << places[i].x << " " << places[i].y;
    // The overlapping ones lack the north-west, and on their outer edge two heights are mixed.
    const glm::dvec2 p = places[i] - glm::dvec2(391000, 5819100);
    if ((p.x > 85 || p.y < -95) && p.x < 295 && p.y > -195) {
      EXPECT_NEAR(overlapping[i], one[i], 1e-9) << p.x << " " << p.y;
    }
  }
  std::vector<double> beyond(1);
  sample_models(models, std::vector<glm::dvec2>{{390999.9, 5819000}}, {}, beyond);
  EXPECT_TRUE(std::isnan(beyond[0])) << "no raster reaches farther than before";
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

// Opens the raster at `path`, which a test wrote, to say more about it.
GDALDatasetUniquePtr reopen(const std::filesystem::path& path) {
  return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
}

TEST(ElevationModel, HeightsInFeetBecomeMetres) {
  const TempFolder folder;
  const auto write = [&](const char* unit, const char* crs) {
    write_raster(folder / "feet.tif", {500000, 5000000, 10, 40, 30, 25832}, whole);
    GDALDatasetUniquePtr set = reopen(folder / "feet.tif");
    if (*unit) set->GetRasterBand(1)->SetUnitType(unit);
    if (*crs) {
      OGRSpatialReference compound;
      compound.SetFromUserInput(crs);
      set->SetSpatialRef(&compound);
    }
  };
  const glm::dvec2 place(9.002, 45.1523);
  write("", "");
  const double value = sample(ElevationModel(folder / "feet.tif"), {place})[0];
  ASSERT_FALSE(std::isnan(value));
  struct Case {
    const char *unit, *crs;
    double metres;
  };
  for (const Case& c :
       {Case{"ft", "", 0.3048}, Case{"US survey foot", "", 1200.0 / 3937},
        Case{"", "EPSG:25832+6360", 1200.0 / 3937}, Case{"metre", "", 1}, Case{"[m]", "", 1},
        Case{"meters above sea level", "", 1}, Case{"foot_survey", "", 1200.0 / 3937},
        Case{"Decimeters", "", 0.1}, Case{"unspecified", "", 1}, Case{"", "EPSG:25832+5715", -1}}) {
    write(c.unit, c.crs);
    EXPECT_NEAR(sample(ElevationModel(folder / "feet.tif"), {place})[0], value * c.metres, 1e-6)
        << c.unit << c.crs;
  }
  write("parsec", "");
  EXPECT_THROW(ElevationModel(folder / "feet.tif"), Error);
}

TEST(ElevationModel, MetresAreSaidToBeAssumedWhereTheCrsCountsFeet) {
  const TempFolder folder;
  const auto assumption = [&](const char* crs, const char* unit) {
    write_raster(folder / "dem.tif", {300000, 60000, 10, 40, 30, 25832}, whole);
    {
      GDALDatasetUniquePtr set = reopen(folder / "dem.tif");
      OGRSpatialReference other;
      other.SetFromUserInput(crs);
      set->SetSpatialRef(&other);
      if (*unit) set->GetRasterBand(1)->SetUnitType(unit);
    }
    return ElevationModel(folder / "dem.tif").assumption();
  };
  EXPECT_NE(assumption("EPSG:2263", "").find("dem.tif taken as metres"), std::string::npos);
  for (const char* crs : {"EPSG:2263+6360", "EPSG:2263+5703", "EPSG:25832", "EPSG:4326"})
    EXPECT_EQ(assumption(crs, ""), "") << crs;
  EXPECT_EQ(assumption("EPSG:2263", "ft"), "");
}

TEST(ElevationModel, TheFirstOfSeveralBandsIsSaidToBeTaken) {
  const TempFolder folder;
  GDALAllRegister();
  const auto assumption = [&](int bands, bool alpha) {
    {
      GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          (folder / "dem.tif").c_str(), 3, 3, bands, GDT_Float32, nullptr));
      double transform[6] = {0, 10, 0, 30, 0, -10};
      set->SetGeoTransform(transform);
      if (alpha) set->GetRasterBand(bands)->SetColorInterpretation(GCI_AlphaBand);
    }
    return ElevationModel(folder / "dem.tif").assumption();
  };
  EXPECT_EQ(assumption(1, false), "");
  EXPECT_EQ(assumption(2, true), "");
  EXPECT_NE(assumption(2, false).find("first band, beside which it has 1 more"), std::string::npos);
}

TEST(ElevationModel, TheEndsOfATypeAreHolesWhateverItsScale) {
  const TempFolder folder;
  const auto heights = [&](GDALDataType type, double fill) {
    GDALAllRegister();
    {
      GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          (folder / "scaled.tif").c_str(), 3, 1, 1, type, nullptr));
      double transform[6] = {0, 10, 0, 10, 0, -10};
      set->SetGeoTransform(transform);
      set->GetRasterBand(1)->SetScale(0.01);
      double values[3] = {5000, fill, 0};
      EXPECT_EQ(
          set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 3, 1, values, 3, 1, GDT_Float64, 0, 0),
          CE_None);
    }
    return sample(ElevationModel(folder / "scaled.tif"), {{5, 5}, {15, 5}, {25, 5}});
  };
  for (const auto& [type, fill] : {std::pair(GDT_Int16, -32768.0),
                                   {GDT_Int16, 32767.0},
                                   {GDT_UInt16, 65535.0},
                                   {GDT_Int32, -2147483648.0}}) {
    const auto found = heights(type, fill);
    EXPECT_NEAR(found[0], 50, 1e-9);
    EXPECT_TRUE(std::isnan(found[1])) << fill;
    EXPECT_EQ(found[2], 0);
  }
}

TEST(ElevationModel, NumbersThatStandForNoHeightAreHolesUndeclaredToo) {
  const TempFolder folder;
  const auto hole = [](int i, int) { return i == 20; };
  const glm::dvec2 in_hole(205, -50), beside(105, -50);
  const auto write = [&](const char* unit, double stored) {
    write_raster(folder / "undeclared.tif", {0, 0, 10, 40, 30, 0}, hole);
    GDALDatasetUniquePtr set = reopen(folder / "undeclared.tif");
    GDALRasterBand& band = *set->GetRasterBand(1);
    band.DeleteNoDataValue();
    if (*unit) band.SetUnitType(unit);
    for (int j = 0; j < 30; ++j)
      ASSERT_EQ(band.RasterIO(GF_Write, 20, j, 1, 1, &stored, 1, 1, GDT_Float64, 0, 0), CE_None);
  };
  const auto is_hole = [&](const char* unit, double stored) {
    write(unit, stored);
    const auto heights = sample(ElevationModel(folder / "undeclared.tif"), {in_hole, beside});
    EXPECT_FALSE(std::isnan(heights[1]));
    return std::isnan(heights[0]);
  };
  for (const double stored : {-9999.0, -9999.9, -999.0, -32768.0, -3.4e38, 9999.0, 1e20})
    EXPECT_TRUE(is_hole("", stored)) << stored;
  EXPECT_TRUE(is_hole("ft", -9999));
  EXPECT_FALSE(is_hole("cm", -9999)) << "99.99 m below the sea";
  EXPECT_FALSE(is_hole("", -420)) << "the Dead Sea";
  EXPECT_FALSE(is_hole("", -5000)) << "the ground of a sea";
}

TEST(ElevationModel, AFileOfAnotherKindIsNamed) {
  const TempFolder folder;
  const auto reason = [&](const std::string& text) {
    test::write_text(folder / "dem.tif", text);
    try {
      ElevationModel model(folder / "dem.tif");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(reason("\x1f\x8b rest").find("gunzip"), std::string::npos);
  EXPECT_NE(reason("PK\x03\x04 rest").find("zip archive: unpack it"), std::string::npos);
  EXPECT_NE(reason("hello").find("none of the formats"), std::string::npos) << reason("hello");
  const std::pair<const char*, const char*> others[] = {
      {"<!DOCTYPE html><html><body/></html>", "it is a web page"},
      {"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"},
      {"LASF rest", "it is a point cloud (LAS, LAZ); a raster"},
      {"<?xml version=\"1.0\"?><CityModel xmlns=\"http://www.opengis.net/citygml/2.0\"/>",
       "it is a city model: it belongs in [city] files"},
      {"<Dataset xmlns=\"http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema\"><DEM/></Dataset>",
       "convert it to GeoTIFF"}};
  for (const auto& [text, words] : others)
    EXPECT_NE(reason(text).find(words), std::string::npos) << reason(text);
}

TEST(ElevationModel, MasksAndAlphaBandsAreHoles) {
  const TempFolder folder;
  GDALAllRegister();
  for (const bool alpha : {false, true}) {
    {
      CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
      GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          (folder / "mask.tif").c_str(), 4, 4, alpha ? 2 : 1, GDT_Float32, nullptr));
      double transform[6] = {0, 10, 0, 40, 0, -10};
      set->SetGeoTransform(transform);
      std::vector<double> heights(16, 7), seen(16, 255);
      heights[5] = seen[5] = 0;
      if (alpha)
        set->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
      else
        set->CreateMaskBand(GMF_PER_DATASET);
      EXPECT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 4, 4, heights.data(), 4, 4,
                                                GDT_Float64, 0, 0),
                CE_None);
      GDALRasterBand* const band =
          alpha ? set->GetRasterBand(2) : set->GetRasterBand(1)->GetMaskBand();
      EXPECT_EQ(band->RasterIO(GF_Write, 0, 0, 4, 4, seen.data(), 4, 4, GDT_Float64, 0, 0),
                CE_None);
      CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
    }
    const ElevationModel model(folder / "mask.tif");
    EXPECT_TRUE(std::isnan(sample(model, {{15, 25}})[0])) << alpha;
    EXPECT_EQ(sample(model, {{35, 5}})[0], 7) << alpha;
  }
}

TEST(ElevationModel, NoDataIsComparedInThePixelsType) {
  const TempFolder folder;
  GDALAllRegister();
  {
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder / "float.tif").c_str(), 2, 1, 1, GDT_Float32, nullptr));
    double transform[6] = {0, 10, 0, 10, 0, -10};
    set->SetGeoTransform(transform);
    std::vector<double> heights{0.1, 5};
    EXPECT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 2, 1, heights.data(), 2, 1,
                                              GDT_Float64, 0, 0),
              CE_None);
    set->GetRasterBand(1)->SetNoDataValue(0.1);  // no float
  }
  const ElevationModel model(folder / "float.tif");
  EXPECT_TRUE(std::isnan(sample(model, {{5, 5}})[0]));
  EXPECT_EQ(sample(model, {{15, 5}})[0], 5);
}

TEST(ElevationModel, LongitudesMayRunFrom0To360) {
  const TempFolder folder;
  write_raster(folder / "west.tif", {288.9, 42.4, 0.01, 20, 20, 4326}, whole);
  EXPECT_NEAR(sample(ElevationModel(folder / "west.tif"), {{-71.0, 42.3}})[0], plane(0.1, -0.1),
              1e-9);
}

TEST(ElevationModel, PicturesInColoursAreRefused) {
  const TempFolder folder;
  GDALAllRegister();
  {
    const char* options[] = {"PHOTOMETRIC=RGB", nullptr};
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder / "rgb.tif").c_str(), 2, 2, 3, GDT_Byte, const_cast<char**>(options)));
    double transform[6] = {0, 10, 0, 20, 0, -10};
    set->SetGeoTransform(transform);
  }
  EXPECT_THROW(ElevationModel(folder / "rgb.tif"), Error);
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

// GDAL unpacks a block as a whole: here one of all rows.
TEST(ElevationModel, BlocksOfTooManyPixelsNameTheKeyThatAllowsThem) {
  const TempFolder folder;
  GDALAllRegister();
  const char* one_strip[] = {"BLOCKYSIZE=1200", "COMPRESS=DEFLATE", nullptr};
  {
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder / "strip.tif").c_str(), 1000, 1200, 1, GDT_Float32, const_cast<char**>(one_strip)));
    ASSERT_TRUE(set);
    double transform[6] = {391000, 1, 0, 5819000, 0, -1};
    set->SetGeoTransform(transform);
  }
  EXPECT_NO_THROW(ElevationModel(folder / "strip.tif", 2));
  try {
    ElevationModel(folder / "strip.tif", 1);
    FAIL() << "was read";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("1000 x 1200 pixels"), std::string::npos) << text;
    EXPECT_NE(text.find("[terrain] max_dem_block_mpx"), std::string::npos) << text;
  }
}

// Germany's heights come as tables of x, y and z, which have no place for a CRS.
TEST(ElevationModel, ATableOfHeightsHasTheCrsBesideItOrTheOneGiven) {
  const TempFolder folder;
  std::string rows;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      rows += std::to_string(391000 + 10 * x) + " " + std::to_string(5819000 + 10 * y) + " 37.5\n";
  test::write_text(folder / "a.xyz", rows);
  EXPECT_FALSE(ElevationModel(folder / "a.xyz").has_crs());
  const glm::dvec2 place(13.39402, 52.51030);  // (391010, 5819010) of EPSG:25833
  const ElevationModel given(folder / "a.xyz", default_max_block_mpx, "EPSG:25833");
  EXPECT_NEAR(sample(given, {place})[0], 37.5, 1e-9);
  EXPECT_THROW(ElevationModel(folder / "a.xyz", default_max_block_mpx, "EPSG:1"), Error);
  EXPECT_THROW(ElevationModel(folder / "a.xyz", default_max_block_mpx, "EPSG:5709"), Error)
      << "a system of heights";
  GDALAllRegister();
  OGRSpatialReference crs;
  crs.importFromEPSG(25833);
  crs.morphToESRI();
  char* text = nullptr;
  crs.exportToWkt(&text);
  test::write_text(folder / "a.prj", text);
  CPLFree(text);
  const ElevationModel beside(folder / "a.xyz", default_max_block_mpx, "EPSG:25832");
  EXPECT_NEAR(sample(beside, {place})[0], 37.5, 1e-9) << "its own goes before the one given";
}

// A plane is met at every place, whatever parallelogram the pixels are.
TEST(ElevationModel, PixelsMayLieAslantOrBePlacedByPoints) {
  const TempFolder folder;
  GDALAllRegister();
  constexpr int size = 40;
  const auto height = [](double x, double y) { return plane(x - 391000, y - 5819000); };
  const auto write = [&](const double(&transform)[6], bool by_points, double bent) {
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder / "a.tif").c_str(), size, size, 1, GDT_Float64, nullptr));
    OGRSpatialReference crs;
    crs.importFromEPSG(25833);
    const auto place = [&](double i, double j) {
      return glm::dvec2(transform[0] + i * transform[1] + j * transform[2],
                        transform[3] + i * transform[4] + j * transform[5]);
    };
    std::array<GDAL_GCP, 5> points{};
    GDALInitGCPs(static_cast<int>(points.size()), points.data());
    for (std::size_t n = 0; n < points.size(); ++n) {
      GDAL_GCP& point = points[n];
      point.dfGCPPixel = n % 2 == 1 ? size : n == 4 ? size / 2 : 0;
      point.dfGCPLine = n == 2 || n == 3 ? size : n == 4 ? size / 2 : 0;
      const glm::dvec2 at = place(point.dfGCPPixel, point.dfGCPLine);
      point.dfGCPX = at.x + (n == 4 ? bent : 0);
      point.dfGCPY = at.y;
    }
    if (by_points) {
      set->SetGCPs(static_cast<int>(points.size()), points.data(), &crs);
    } else {
      set->SetGeoTransform(const_cast<double*>(transform));
      set->SetSpatialRef(&crs);
    }
    GDALDeinitGCPs(static_cast<int>(points.size()), points.data());
    std::vector<double> values;
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        const glm::dvec2 at = place(i + 0.5, j + 0.5);
        values.push_back(height(at.x, at.y));
      }
    ASSERT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, size, size, values.data(), size, size,
                                              GDT_Float64, 0, 0),
              CE_None);
  };
  // (391020, 5819010) of EPSG:25833 (dem_raster_test.cpp).
  const glm::dvec2 place(13.394162598, 52.510303463);
  for (const bool by_points : {false, true})
    for (const auto& transform : {std::to_array<double>({390980, 2, 0, 5819050, 0, -2}),
                                  std::to_array<double>({390980, 1.7, 1, 5819010, 1, -1.7}),
                                  std::to_array<double>({390980, 2, 0.7, 5819050, 0, -2}),
                                  std::to_array<double>({391060, -2, 0, 5818970, 0, 2})}) {
      double six[6];
      std::copy(transform.begin(), transform.end(), six);
      write(six, by_points, 0);
      EXPECT_NEAR(sample(ElevationModel(folder / "a.tif"), {place})[0], height(391020, 5819010),
                  0.001)
          << by_points << " " << transform[1] << " " << transform[2];
    }
  const double straight[6] = {390980, 2, 0, 5819050, 0, -2};
  write(straight, true, 30);
  try {
    ElevationModel(folder / "a.tif");
    FAIL() << "was placed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("gdalwarp -t_srs"), std::string::npos) << error.what();
  }
}

TEST(ElevationModel, BytesAreTold) {
  const TempFolder folder;
  GDALAllRegister();
  for (const GDALDataType type : {GDT_Byte, GDT_Int16}) {
    {
      GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          (folder / "b.tif").c_str(), 4, 4, 1, type, nullptr));
      double transform[6] = {391000, 1, 0, 5819000, 0, -1};
      set->SetGeoTransform(transform);
    }
    EXPECT_EQ(ElevationModel(folder / "b.tif").assumption().empty(), type != GDT_Byte);
  }
}

TEST(ElevationModel, RefusesWhatIsNoRaster) {
  const TempFolder folder;
  try {
    ElevationModel(folder.path());
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("is a folder"), std::string::npos) << error.what();
  }
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

TEST(ElevationModel, FormatsThatLeadElsewhereAreRefused) {
  const TempFolder folder;
  write_raster(folder / "inner.tif", {391000, 5819000, 10, 8, 6, 25833}, whole);
  const auto refuses = [&](const char* name, const std::string& text, const char* format) {
    test::write_text(folder / name, text);
    try {
      ElevationModel model(folder / name);
      ADD_FAILURE() << name << " was opened";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(format), std::string::npos) << error.what();
    }
  };
  refuses(
      "dem.vrt",
      "<VRTDataset rasterXSize=\"8\" rasterYSize=\"6\"><GeoTransform>391000, 10, 0, 5819000, 0, "
      "-10</GeoTransform><VRTRasterBand dataType=\"Float64\" band=\"1\"><SimpleSource>"
      "<SourceFilename relativeToVRT=\"1\">inner.tif</SourceFilename><SourceBand>1</SourceBand>"
      "</SimpleSource></VRTRasterBand></VRTDataset>",
      "VRT");
  refuses(
      "dem.tif",  // whatever its name says
      "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>http://127.0.0.1:9/${z}/${x}/${y}.png</ServerUrl>"
      "</Service><DataWindow><UpperLeftX>0</UpperLeftX><UpperLeftY>0</UpperLeftY><LowerRightX>1"
      "</LowerRightX><LowerRightY>-1</LowerRightY><SizeX>8</SizeX><SizeY>8</SizeY></DataWindow>"
      "<BandsCount>1</BandsCount></GDAL_WMS>",
      "WMS");
}

TEST(ElevationModel, NothingIsReadFromTheNetwork) {
  const TempFolder folder;
  write_raster(folder / "dem.tif", {391000, 5819000, 10, 8, 6, 25833}, whole);
  const ElevationModel model(folder / "dem.tif");  // the first one sets GDAL up
  for (const char* name :
       {"/vsicurl/http://127.0.0.1:9/a.tif", "/vsis3/bucket/a.tif", "/vsigs_streaming/bucket/a.tif",
        "/vsicurl?url=http://127.0.0.1:9/a.tif"}) {
    VSIStatBufL status;
    errno = 0;
    EXPECT_NE(VSIStatL(name, &status), 0);
    EXPECT_EQ(errno, EACCES) << name << " was asked for";
    EXPECT_EQ(VSIFOpenL(name, "rb"), nullptr);
  }
}

TEST(ElevationModel, AFifoIsRefusedAtOnce) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "dem.tif").c_str(), 0600), 0);
  EXPECT_THROW(ElevationModel(folder / "dem.tif"), Error);
}

TEST(ElevationModel, ATextThatIsCutOffIsToldByItsFirstMissingRow) {
  const TempFolder folder;
  const auto write = [&](int rows) {
    std::string text = "ncols 2\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int i = 0; i < rows; ++i) text += std::to_string(i) + " 7\n";
    test::write_text(folder / "cut.asc", text);
    return ElevationModel(folder / "cut.asc");
  };
  EXPECT_EQ(sample(write(60), {{0.5, 0.5}})[0], 59);
  const ElevationModel cut = write(10);
  EXPECT_EQ(sample(cut, {{0.5, 50.5}})[0], 9);
  // By GDAL alone the last row takes 2^49 steps.
  for (const double y : {0.5, 30.5}) try {
      sample(cut, {{0.5, y}});
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("row 11 of 60 cannot be read"), std::string::npos)
          << error.what();
    }
}

}  // namespace
}  // namespace nightcity::terrain
