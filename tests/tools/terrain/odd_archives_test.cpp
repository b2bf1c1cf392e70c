// Archives of elevation models that are unclear, hostile, or very large.
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/tools/terrain/packed_models.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/gdal/scratch_files.h"

namespace nightcity::terrain {
namespace {

using test::TempFolder;
using test::write_text;

// One name stands for one file: the heights of the other would be lost.
TEST(OddArchives, RastersOfOneNameAreRefused) {
  const TempFolder folder;
  const auto path = folder / "a.zip";
  for (const Entries& entries :
       {Entries{{"a/b.asc", make_ascii_grid(1)}, {"a\\b.asc", make_ascii_grid(2)}},
        Entries{{"dem.xyz", make_table(1)}, {"dem.xyz.gz", to_gzip(make_table(2))}}}) {
    pack_zip(path, entries);
    const std::string why = why_not(path);
    EXPECT_NE(why.find("more than once"), std::string::npos) << why;
  }
}

TEST(OddArchives, SignsInNamesMeanNothing) {
  const TempFolder folder;
  pack_zip(folder / "inner.zip", {{"dem.asc", make_ascii_grid(7)}});
  for (const char* name : {"a}b{.zip", "}.zip", "%s.zip", "a,b.zip", "/vsizip/x.zip"}) {
    pack_zip(folder / "a.zip", {{name, test::read_text(folder / "inner.zip")}});
    EXPECT_EQ(heights_of(folder / "a.zip"), std::vector<double>{7}) << name;
  }
}

// A cloud of points or a document of the same name is none of a raster's files.
TEST(OddArchives, WhatGdalDoesNotReadIsNotUnpacked) {
  const TempFolder folder;
  const std::string large(2'000'000, 'x');
  ElevationOptions options;
  options.max_unpacked_mb = 1;
  pack_zip(folder / "a.zip", {{"dem.asc", make_ascii_grid(7)},
                              {"dem.laz", large},
                              {"dem.pdf", large},
                              {"other.xml", large}});
  EXPECT_EQ(heights_of(folder / "a.zip", options), std::vector<double>{7});
  pack_zip(folder / "a.zip", {{"dem.asc", make_ascii_grid(7)}, {"dem.aux.xml", large}});
  EXPECT_NE(why_not(folder / "a.zip", options).find("max_dem_unpacked_mb"), std::string::npos);
}

TEST(OddArchives, RastersOfNoHeightsAloneAreNamed) {
  const TempFolder folder;
  write_text(folder / "x_num.asc", make_ascii_grid(9));
  const std::string why = why_not(folder.path());
  EXPECT_NE(why.find("x_num.asc"), std::string::npos) << why;
  EXPECT_EQ(heights_of(folder / "x_num.asc"), std::vector<double>{9}) << "named itself";
  EXPECT_TRUE(is_about_heights("TDM1_DEM__30_N52E013_COV.tif"));
  EXPECT_FALSE(is_about_heights("TDM1_DEM__30_N52E013_DEM.tif"));
}

// The transformation of a CRS is made once for all tiles of it.
TEST(OddArchives, TilesOfOneCrsAndOfOthersArePlaced) {
  const TempFolder folder;
  const std::string other = R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",)"
                            R"(6378137,298.257223563]],PRIMEM["Greenwich",0],)"
                            R"(UNIT["Degree",0.0174532925199433]])";
  const std::string degrees =
      "ncols 2\nnrows 2\nxllcorner 13.39\nyllcorner 52.51\ncellsize 0.01\n3 3\n3 3\n";
  pack_zip(folder / "a.zip", {{"a.asc", make_ascii_grid(1)},
                              {"a.prj", make_prj()},
                              {"b.asc", make_ascii_grid(2)},
                              {"b.prj", make_prj()},
                              {"c.asc", degrees},
                              {"c.prj", other},
                              {"d.asc", make_ascii_grid(4)},
                              {"d.prj", make_prj()}});
  std::vector<double> heights = heights_of(folder / "a.zip");
  std::sort(heights.begin(), heights.end());
  EXPECT_EQ(heights, (std::vector<double>{1, 2, 3, 4}));
}

// GDAL asks for the neighbours of each file that it opens.
TEST(OddArchives, AFolderIsListedAsFarAsIsAsked) {
  gdal::register_drivers();
  const TempFolder folder;
  gdal::ScratchFiles files(folder.path());
  std::string name;
  for (int i = 0; i < 100; ++i)
    name = files.add("a/" + std::to_string(i), [](char*, std::size_t) { return std::size_t{0}; });
  const std::string in = name.substr(0, name.rfind('/'));
  EXPECT_EQ(CPLStringList(VSIReadDirEx(in.c_str(), 0), TRUE).Count(), 100);
  EXPECT_EQ(CPLStringList(VSIReadDirEx(in.c_str(), 10), TRUE).Count(), 11) << "more than 10";
}

}  // namespace
}  // namespace nightcity::terrain
