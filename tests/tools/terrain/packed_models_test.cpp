// Elevation models as portals pack them.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <zip.h>
#include <zlib.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/terrain/open_models.h"
#include "tools/terrain/packed_rasters.h"
#include "tools/terrain/raster_names.h"

namespace nightcity::terrain {
namespace {

using test::read_text;
using test::TempFolder;
using test::write_text;

using Entries = std::map<std::string, std::string>;

void pack_zip(const std::filesystem::path& path, const Entries& entries) {
  zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, bytes] : entries)
    zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0);
  ASSERT_EQ(zip_close(zip), 0);
}

void pack_gzip(const std::filesystem::path& path, const std::string& bytes) {
  const gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
            static_cast<int>(bytes.size()));
  gzclose(file);
}

std::string to_gzip(const std::string& bytes) {
  const TempFolder folder;
  pack_gzip(folder / "a.gz", bytes);
  return read_text(folder / "a.gz");
}

// A grid of 3 x 3 heights in a plan of metres, whose middle is 391010, 5819010.
std::string make_grid(double height) {
  std::string text =
      "ncols 3\nnrows 3\nxllcorner 390995\nyllcorner 5818995\ncellsize 10\nNODATA_value -9999\n";
  for (int i = 0; i < 9; ++i) text += std::to_string(height) + (i % 3 == 2 ? "\n" : " ");
  return text;
}

std::string make_table(double height) {
  std::string rows;
  for (int y = 2; y >= 0; --y)
    for (int x = 0; x < 3; ++x)
      rows += std::to_string(391000 + 10 * x) + " " + std::to_string(5819000 + 10 * y) + " " +
              std::to_string(height) + "\n";
  return rows;
}

// A GeoTIFF without a place of its own.
std::string make_tiff(float height, GDALDataType type = GDT_Float32) {
  const TempFolder folder;
  GDALAllRegister();
  {
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder / "a.tif").c_str(), 3, 3, 1, type, nullptr));
    std::vector<float> values(9, height);
    EXPECT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 3, 3, values.data(), 3, 3,
                                              GDT_Float32, 0, 0),
              CE_None);
  }
  return read_text(folder / "a.tif");
}

constexpr const char* world_file = "10\n0\n0\n-10\n391000\n5819020\n";
constexpr glm::dvec2 in_plan(391010, 5819010), in_degrees(13.39402, 52.51030);

std::string make_prj() {
  OGRSpatialReference crs;
  crs.importFromEPSG(25833);
  crs.morphToESRI();
  char* text = nullptr;
  crs.exportToWkt(&text);
  const std::string made = text;
  CPLFree(text);
  return made;
}

double height_of(const ElevationModel& model) {
  double height = 0;
  const glm::dvec2 place = model.has_crs() ? in_degrees : in_plan;
  model.sample(std::span(&place, 1), std::span(&height, 1));
  return height;
}

std::vector<double> heights_of(const std::filesystem::path& path,
                               const ElevationOptions& options = {}) {
  std::vector<double> heights;
  for (const ElevationModel& model : open_elevation_models(list_raster_files(path), options))
    heights.push_back(height_of(model));
  return heights;
}

std::string why_not(const std::filesystem::path& path, const ElevationOptions& options = {}) {
  try {
    heights_of(path, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "was read";
}

using Heights = std::vector<double>;

TEST(PackedModels, RastersLieInArchivesWithWhatBelongsToThem) {
  const TempFolder folder;
  const auto path = folder / "a.zip";
  for (const char* stem : {"dem", "data/tiles/dem", "../../../../tmp/dem", "/dem", "a.b/dem"}) {
    const std::string name = stem;
    pack_zip(path, {{name + ".asc", make_grid(37.5)}, {"readme.txt", "x"}});
    EXPECT_EQ(heights_of(path), Heights{37.5}) << name;
    pack_zip(path, {{name + ".tif", make_tiff(37.5)},
                    {name + ".tfw", world_file},
                    {name + ".prj", make_prj()}});
    EXPECT_EQ(heights_of(path), Heights{37.5}) << name;
    EXPECT_TRUE(open_elevation_models({path}, {}).front().has_crs()) << name;
  }
  pack_zip(path, {{"DEM.TIF", make_tiff(37.5)}, {"DEM.TFW", world_file}, {"DEM.PRJ", make_prj()}});
  EXPECT_EQ(heights_of(path), Heights{37.5});
  EXPECT_TRUE(open_elevation_models({path}, {}).front().has_crs());
  pack_zip(path, {{"a/dem.xyz", make_table(1)}, {"b/dem.xyz", make_table(2)}, {"c.html", "x"}});
  EXPECT_EQ(heights_of(path), (Heights{1, 2})) << "of one name in two folders";
  EXPECT_EQ(open_elevation_models({path}, {}).front().name(), path.string() + "/a/dem.xyz");
  pack_zip(path, {{"dgm1.txt", make_table(3)}, {"readme.txt", "Licence: dl-de/by-2-0"}});
  EXPECT_EQ(heights_of(path), Heights{3}) << "a text where there is nothing else";
  pack_zip(path, {{"dgm1.xyz.gz", to_gzip(make_table(4))}, {"index.csv", "tile,year\na,2020\n"}});
  EXPECT_EQ(heights_of(path), Heights{4}) << "packed twice";
}

// As Britain's OS Terrain 50 comes: a small archive for each tile in a large one.
TEST(PackedModels, ArchivesLieInArchives) {
  const TempFolder folder;
  pack_zip(folder / "tile.zip",
           {{"TQ38.asc", make_grid(37.5)}, {"TQ38.prj", make_prj()}, {"__MACOSX/._TQ38.asc", "x"}});
  pack_zip(folder / "deep.zip", {{"a.zip", read_text(folder / "tile.zip")}});
  pack_zip(folder / "all.zip", {{"data/tq/tq38.zip", read_text(folder / "tile.zip")},
                                {"data/deep.zip", read_text(folder / "deep.zip")},
                                {"readme.txt", "x"}});
  const auto models = open_elevation_models({folder / "all.zip"}, {});
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(height_of(models[0]), 37.5);
  EXPECT_TRUE(models[0].has_crs());
  EXPECT_EQ(models[0].name(), (folder / "all.zip").string() + "/data/tq/tq38.zip/TQ38.asc");
}

// Heights of 32 to 255 m in whole numbers of two bytes look like Latin text in UTF-16.
TEST(PackedModels, BytesOfARasterAreNoText) {
  const TempFolder folder;
  constexpr std::size_t pixels = 1201 * 1201;
  std::string hgt(2 * pixels, '\0');
  for (std::size_t i = 0; i < pixels; ++i) hgt[2 * i + 1] = 'A';
  pack_zip(folder / "N52E013.hgt.zip", {{"N52E013.hgt", hgt}});
  EXPECT_EQ(heights_of(folder / "N52E013.hgt.zip"), Heights{65});
  pack_gzip(folder / "N52E013.hgt.gz", hgt);
  EXPECT_EQ(heights_of(folder / "N52E013.hgt.gz"), Heights{65});
}

TEST(PackedModels, AGzipStreamHasItsNeighbours) {
  const TempFolder folder;
  pack_gzip(folder / "dem.asc.gz", make_grid(37.5));
  EXPECT_EQ(heights_of(folder / "dem.asc.gz"), Heights{37.5});
  EXPECT_FALSE(open_elevation_models({folder / "dem.asc.gz"}, {}).front().has_crs());
  write_text(folder / "dem.prj", make_prj());
  EXPECT_TRUE(open_elevation_models({folder / "dem.asc.gz"}, {}).front().has_crs());
  pack_gzip(folder / "dem.tif.gz", make_tiff(12));
  write_text(folder / "dem.tfw", world_file);
  EXPECT_EQ(heights_of(folder / "dem.tif.gz"), Heights{12});
  pack_gzip(folder / "plain", make_grid(5));
  EXPECT_EQ(heights_of(folder / "plain"), Heights{5}) << "a stream under a plain name";
}

TEST(PackedModels, AFolderStandsForTheRastersInIt) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "b");
  write_text(folder / "a.asc", make_grid(1));
  pack_zip(folder / "b" / "c.zip", {{"c.asc", make_grid(2)}});
  pack_gzip(folder / "d.xyz.gz", make_table(3));
  for (const char* other : {"readme.txt", ".hidden.asc", "e.pdf", "a_hillshade.asc"})
    write_text(folder / other, "x");
  EXPECT_EQ(heights_of(folder.path()), (Heights{1, 2, 3}));
  const TempFolder empty;
  EXPECT_NE(why_not(empty.path()).find("no .tif, "), std::string::npos) << why_not(empty.path());
}

TEST(PackedModels, WhatTellsHowGoodHeightsAreIsNoHeight) {
  const TempFolder folder;
  const auto path = folder / "a.zip";
  const std::string cop = "Copernicus_DSM_10_N52_00_E013_00_";
  pack_zip(path, {{cop + "DEM.asc", make_grid(34)},
                  {"AUXFILES/" + cop + "EDM.asc", make_grid(1)},
                  {"AUXFILES/" + cop + "HEM.asc", make_grid(0.5)},
                  {"AUXFILES/" + cop + "WBM.asc", make_grid(0)}});
  EXPECT_EQ(heights_of(path), Heights{34});
  pack_zip(path,
           {{"ASTGTM_N52E013_dem.asc", make_grid(35)}, {"ASTGTM_N52E013_num.asc", make_grid(9)}});
  EXPECT_EQ(heights_of(path), Heights{35});
  EXPECT_FALSE(is_about_heights("dgm_num_3.tif"));
  EXPECT_FALSE(is_about_heights("slope.tif")) << "it may be a place";
}

TEST(PackedModels, WhatIsNotReadIsNamed) {
  const TempFolder folder;
  const auto path = folder / "a.zip";
  const auto expect = [&](const Entries& entries, const char* words) {
    pack_zip(path, entries);
    const std::string why = why_not(path);
    EXPECT_NE(why.find(words), std::string::npos) << why;
    EXPECT_NE(why.find(path.string()), std::string::npos) << why;
  };
  expect({{"readme.pdf", "%PDF"}}, "holds no elevation model, but");
  expect({{"a.zip", "PK\x03\x04"}}, "a.zip/a.zip: broken zip archive");
  expect({{"a.7z", "7z"}}, "holds no elevation model, but");
  expect({{"dem.flt", "x"}}, "dem.flt: is no raster of heights: the .hdr that belongs to it");
  expect({{"readme.txt", "hello"}}, "readme.txt: is no raster of heights");
  expect({{"dem.tif", "hello"}, {"b.asc", make_grid(1)}}, "dem.tif: is no raster of heights");
  expect({{"dem.asc", "<VRTDataset rasterXSize=\"1\" rasterYSize=\"1\"/>"}}, "format VRT");
  expect({{"a.xyz.gz", "\x1f\x8b\x08 broken"}}, "a.xyz: broken gzip stream");
  expect({{"x_num.tif", make_tiff(1)}}, "holds no elevation model");
  std::string cut = read_text(path);
  cut.resize(cut.size() / 2);
  write_text(path, cut);
  EXPECT_NE(why_not(path).find("broken zip archive"), std::string::npos) << why_not(path);
}

ElevationOptions bounded_by(int megabytes) {
  ElevationOptions options;
  options.max_unpacked_mb = megabytes;
  return options;
}

TEST(PackedModels, HowMuchIsUnpackedIsBoundedInAll) {
  const TempFolder folder;
  const std::string megabyte = make_grid(1) + std::string(700'000, ' ');
  pack_zip(folder / "a.zip", {{"a.asc", megabyte}});
  pack_zip(folder / "b.zip", {{"b.asc", megabyte}});
  EXPECT_EQ(why_not(folder / "a.zip", bounded_by(1)), "was read");
  const std::string why = why_not(folder.path(), bounded_by(1));
  EXPECT_NE(why.find("max_dem_unpacked_mb in [terrain] = 1"), std::string::npos) << why;
  EXPECT_EQ(why_not(folder.path(), bounded_by(2)), "was read");
}

TEST(PackedModels, NothingIsLeftInTheTemporaryFolder) {
  const TempFolder folder, scratch;
  pack_zip(folder / "a.zip", {{"a.asc", make_grid(1)}, {"b.asc", "broken"}});
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", scratch.path().c_str(), 1);
  EXPECT_NE(why_not(folder / "a.zip"), "was read");
  pack_zip(folder / "a.zip", {{"a.asc", make_grid(1)}});
  {
    const auto models = open_elevation_models({folder / "a.zip"}, {});
    EXPECT_EQ(scratch.entries(), 0u) << "while it is read";
    EXPECT_EQ(height_of(models.front()), 1);
  }
  EXPECT_EQ(scratch.entries(), 0u);
  if (before)
    ::setenv("TMPDIR", kept.c_str(), 1);
  else
    ::unsetenv("TMPDIR");
}

TEST(PackedModels, AnArchiveOfRastersIsKnownByItsNames) {
  const TempFolder folder;
  pack_zip(folder / "a.zip", {{"a.asc", "x"}, {"index.shp", "x"}});
  EXPECT_TRUE(holds_packed_rasters(folder / "a.zip"));
  pack_zip(folder / "a.zip", {{"lamps.csv", "x"}, {"readme.txt", "x"}});
  EXPECT_FALSE(holds_packed_rasters(folder / "a.zip"));
  write_text(folder / "a.tif", "x");
  EXPECT_FALSE(holds_packed_rasters(folder / "a.tif")) << "not packed";
}

}  // namespace
}  // namespace nightcity::terrain
