// Elevation models as portals pack them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/tools/terrain/packed_models.h"
#include "tools/terrain/packed_rasters.h"

namespace nightcity::terrain {
namespace {

using test::read_text;
using test::TempFolder;
using test::write_text;

using Heights = std::vector<double>;

TEST(PackedModels, RastersLieInArchivesWithWhatBelongsToThem) {
  const TempFolder folder;
  const auto path = folder / "a.zip";
  for (const char* stem : {"dem", "data/tiles/dem", "../../../../tmp/dem", "/dem", "a.b/dem"}) {
    const std::string name = stem;
    pack_zip(path, {{name + ".asc", make_ascii_grid(37.5)}, {"readme.txt", "x"}});
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
  pack_zip(folder / "tile.zip", {{"TQ38.asc", make_ascii_grid(37.5)},
                                 {"TQ38.prj", make_prj()},
                                 {"__MACOSX/._TQ38.asc", "x"}});
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
  pack_gzip(folder / "dem.asc.gz", make_ascii_grid(37.5));
  EXPECT_EQ(heights_of(folder / "dem.asc.gz"), Heights{37.5});
  EXPECT_FALSE(open_elevation_models({folder / "dem.asc.gz"}, {}).front().has_crs());
  write_text(folder / "dem.prj", make_prj());
  EXPECT_TRUE(open_elevation_models({folder / "dem.asc.gz"}, {}).front().has_crs());
  pack_gzip(folder / "dem.tif.gz", make_tiff(12));
  write_text(folder / "dem.tfw", world_file);
  EXPECT_EQ(heights_of(folder / "dem.tif.gz"), Heights{12});
  pack_gzip(folder / "plain", make_ascii_grid(5));
  EXPECT_EQ(heights_of(folder / "plain"), Heights{5}) << "a stream under a plain name";
}

TEST(PackedModels, AFolderStandsForTheRastersInIt) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "b");
  write_text(folder / "a.asc", make_ascii_grid(1));
  pack_zip(folder / "b" / "c.zip", {{"c.asc", make_ascii_grid(2)}});
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
  pack_zip(path, {{cop + "DEM.asc", make_ascii_grid(34)},
                  {"AUXFILES/" + cop + "EDM.asc", make_ascii_grid(1)},
                  {"AUXFILES/" + cop + "HEM.asc", make_ascii_grid(0.5)},
                  {"AUXFILES/" + cop + "WBM.asc", make_ascii_grid(0)}});
  EXPECT_EQ(heights_of(path), Heights{34});
  pack_zip(path, {{"ASTGTM_N52E013_dem.asc", make_ascii_grid(35)},
                  {"ASTGTM_N52E013_num.asc", make_ascii_grid(9)}});
  EXPECT_EQ(heights_of(path), Heights{35});
  EXPECT_FALSE(is_about_heights("dgm_num_3.tif"));
  EXPECT_FALSE(is_about_heights("slope.tif")) << "it may be a place";
}

// IGN delivers .7z, others tars: with world files, .prj and rasters that speak of no heights.
TEST(PackedModels, EveryFormHoldsTheSameHeights) {
  const TempFolder folder;
  const Entries files{{"RGEALTI/SUPP/RGEALTI_FXX_0390_5819_DST_5M.asc", make_ascii_grid(9)},
                      {"RGEALTI/MNT/a.tif", make_tiff(37.5)},
                      {"RGEALTI/MNT/a.tfw", world_file},
                      {"RGEALTI/MNT/a.prj", make_prj()},
                      {"RGEALTI/LISEZ_MOI.txt", "x"}};
  for (const char* form : test::archive_forms) {
    const auto path = folder / ("a" + std::string(form));
    test::pack_archive(path, files);
    EXPECT_EQ(heights_of(path), Heights{37.5}) << form;
    EXPECT_TRUE(open_elevation_models({path}, {}).front().has_crs()) << form;
    EXPECT_TRUE(holds_packed_rasters(path)) << form;
  }
  for (const char* form : test::stream_forms) {
    const auto path = folder / ("a.asc" + std::string(form));
    test::pack_stream(path, make_ascii_grid(12));
    write_text(folder / "a.prj", make_prj());
    EXPECT_EQ(heights_of(path), Heights{12}) << form;
    EXPECT_TRUE(open_elevation_models({path}, {}).front().has_crs()) << form;
    EXPECT_TRUE(holds_packed_rasters(path)) << form;
    pack_zip(folder / "b.zip", {{"in/a.asc" + std::string(form), read_text(path)}});
    EXPECT_EQ(heights_of(folder / "b.zip"), Heights{12}) << form;
  }
}

TEST(PackedModels, FoldersAreSearchedForArchives) {
  const TempFolder folder;
  test::pack_archive(folder / "a.7z", {{"a.asc", make_ascii_grid(1)}});
  test::pack_archive(folder / "b.tar.gz", {{"b.asc", make_ascii_grid(2)}});
  test::pack_stream(folder / "c.asc.xz", make_ascii_grid(3));
  EXPECT_EQ(heights_of(folder.path()), (Heights{1, 2, 3}));
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
  expect({{"dem.tif", "hello"}, {"b.asc", make_ascii_grid(1)}}, "dem.tif: is no raster of heights");
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
  const std::string megabyte = make_ascii_grid(1) + std::string(700'000, ' ');
  pack_zip(folder / "a.zip", {{"a.asc", megabyte}});
  pack_zip(folder / "b.zip", {{"b.asc", megabyte}});
  EXPECT_EQ(why_not(folder / "a.zip", bounded_by(1)), "was read");
  const std::string why = why_not(folder.path(), bounded_by(1));
  EXPECT_NE(why.find("max_dem_unpacked_mb in [terrain] = 1"), std::string::npos) << why;
  EXPECT_EQ(why_not(folder.path(), bounded_by(2)), "was read");
}

TEST(PackedModels, NothingIsLeftInTheTemporaryFolder) {
  const TempFolder folder, scratch;
  pack_zip(folder / "a.zip", {{"a.asc", make_ascii_grid(1)}, {"b.asc", "broken"}});
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", scratch.path().c_str(), 1);
  EXPECT_NE(why_not(folder / "a.zip"), "was read");
  pack_zip(folder / "a.zip", {{"a.asc", make_ascii_grid(1)}});
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
