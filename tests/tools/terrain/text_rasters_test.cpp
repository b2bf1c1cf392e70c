// Heights in text, in the forms that surveys write.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/terrain/gsi_grid.h"
#include "tools/terrain/open_models.h"

namespace nightcity::terrain {
namespace {

using test::TempFolder;
using test::write_text;

// A plane of 21 x 21 points, which is 37.5 at 391020, 5819010.
std::string make_plane(double first_digits = 0) {
  std::string rows;
  for (int y = 20; y >= 0; --y)
    for (int x = 0; x <= 20; ++x)
      rows += std::to_string(static_cast<int>(first_digits) + 391010 + x) + " " +
              std::to_string(5819000 + y) + " " +
              std::to_string(37.5 + 0.5 * (x - 10) + 0.05 * (y - 10)) + "\n";
  return rows;
}

double height_of(const std::filesystem::path& path, const glm::dvec2& place,
                 const std::string& crs) {
  double height = 0;
  open_elevation_models({path}, {.crs_without = crs})
      .front()
      .sample(std::span(&place, 1), std::span(&height, 1));
  return height;
}

// 391020, 5819010 of EPSG:25833.
constexpr glm::dvec2 place(13.394162598, 52.510303463);

std::string to_wide(const std::string& text, bool big_endian) {
  std::string wide = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) {
    if (big_endian) wide += '\0';
    wide += c;
    if (!big_endian) wide += '\0';
  }
  return wide;
}

TEST(TextRasters, MarksCommentsAndWideLettersAreNoMatter) {
  const TempFolder folder;
  const std::string plane = make_plane();
  for (const std::string& text :
       {plane, "\xef\xbb\xbf" + plane, "# DGM1\n# x y z\n" + plane, "#x y z\r\n" + plane,
        to_wide(plane, false), to_wide(plane, true), to_wide(plane, false).substr(2)}) {
    write_text(folder / "a.xyz", text);
    EXPECT_NEAR(height_of(folder / "a.xyz", place, "EPSG:25833"), 37.5, 1e-4) << text.substr(0, 40);
  }
  write_text(folder / "a.asc",
             "\xef\xbb\xbfncols 2\nnrows 2\nxllcorner 391010\nyllcorner 5819000\ncellsize 10\n"
             "7 7\n7 7\n");
  write_text(folder / "a.prj", "nothing");  // no definition: the one given is taken
  EXPECT_NEAR(height_of(folder / "a.asc", place, "EPSG:25833"), 7, 1e-9);
}

// A comment may say in which order the columns are, without which they are x, y and z.
TEST(TextRasters, ACommentTellsTheOrderOfColumns) {
  const TempFolder folder;
  std::string rows;
  for (int y = 20; y >= 0; --y)
    for (int x = 0; x <= 20; ++x)
      rows += std::to_string(5819000 + y) + " " + std::to_string(391010 + x) + " " +
              std::to_string(37.5 + 0.5 * (x - 10) + 0.05 * (y - 10)) + "\n";
  for (const char* comment : {"# DGM1\n# Y X Z\n", "#north east height\r\n", "# y x z\n# 2026\n"}) {
    write_text(folder / "a.xyz", comment + rows);
    EXPECT_NEAR(height_of(folder / "a.xyz", place, "EPSG:25833"), 37.5, 1e-4) << comment;
  }
}

// Surveys of Germany write the number of the zone before the easting.
TEST(TextRasters, EastingsMayBeginWithTheirZone) {
  const TempFolder folder;
  write_text(folder / "a.xyz", make_plane(33e6));
  EXPECT_NEAR(height_of(folder / "a.xyz", place, "EPSG:25833"), 37.5, 1e-4);
  EXPECT_NEAR(height_of(folder / "a.xyz", place, "EPSG:5650"), 37.5, 1e-4) << "which counts so";
  write_text(folder / "a.xyz", make_plane(32e6));
  EXPECT_TRUE(std::isnan(height_of(folder / "a.xyz", place, "EPSG:25833"))) << "another zone";
}

std::string make_gsi(const std::string& heights, const char* start = "0 0") {
  return std::string(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<Dataset xmlns:gml=\"http://www.opengis.net/gml/3.2\" "
             "xmlns=\"http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema\">\n<DEM gml:id=\"DEM001\">"
             "<coverage gml:id=\"DEM001-3\">\n<gml:boundedBy>"
             "<gml:Envelope srsName=\"fguuid:jgd2011.bl\">\n"
             "<gml:lowerCorner>35.50 139.60</gml:lowerCorner>\n"
             "<gml:upperCorner>35.52 139.63</gml:upperCorner>\n"
             "</gml:Envelope></gml:boundedBy><gml:gridDomain><gml:Grid><gml:limits>"
             "<gml:GridEnvelope><gml:low>0 0</gml:low><gml:high>2 1</gml:high>"
             "</gml:GridEnvelope></gml:limits></gml:Grid></gml:gridDomain><gml:rangeSet>"
             "<gml:DataBlock><gml:tupleList>\n") +
         heights +
         "</gml:tupleList></gml:DataBlock></gml:rangeSet><gml:coverageFunction><gml:GridFunction>"
         "<gml:sequenceRule order=\"+x-y\">Linear</gml:sequenceRule><gml:startPoint>" +
         start +
         "</gml:startPoint></gml:GridFunction></gml:coverageFunction></coverage></DEM></Dataset>\n";
}

// From the north-west to the east, row by row; what is missing at both ends has no height.
TEST(TextRasters, GridsOfJapansSurveyAreRead) {
  const TempFolder folder;
  const auto path = folder / "FG-GML-5339-45-00-DEM5A-20161001.xml";
  write_text(path, make_gsi("地表面,1.5\n地表面,2.\nその他,3\n海水面,4\n地表面,5.25\n地表面,6\n"));
  const double east[] = {139.601, 139.615, 139.629};
  const double heights[] = {1.5, 2, 3, 4, 5.25, 6};
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(height_of(path, {east[i % 3], i < 3 ? 35.519 : 35.501}, ""), heights[i], 1e-4) << i;
  write_text(path, make_gsi("地表面,7\n地表面,8\nデータなし,-9999.\n地表面,9\n", "2 0"));
  EXPECT_NEAR(height_of(path, {139.629, 35.519}, ""), 7, 1e-4);
  EXPECT_NEAR(height_of(path, {139.601, 35.501}, ""), 8, 1e-4);
  EXPECT_NEAR(height_of(path, {139.629, 35.501}, ""), 9, 1e-4);
  for (const glm::dvec2 nothing : {glm::dvec2(139.601, 35.519), glm::dvec2(139.615, 35.501)})
    EXPECT_TRUE(std::isnan(height_of(path, nothing, "")));
}

TEST(TextRasters, BrokenGridsOfJapansSurveyAreRefused) {
  const std::string whole = make_gsi("x,1\n");
  for (const auto& [from, to] : {std::pair<const char*, const char*>{"lowerCorner>35", "lower>35"},
                                 {"high>2 1", "high>2000000 100000"},
                                 {"high>2 1", "high>-7 1"},
                                 {"high>2 1", "high>2.5 1"},
                                 {"+x-y", "+x+y"},
                                 {"startPoint>0 0", "startPoint>9 9"},
                                 {"x,1\n", "1\n2\n3\n4\n5\n6\n7\n"}}) {
    std::string text = whole;
    text.replace(text.find(from), std::string_view(from).size(), to);
    EXPECT_THROW(read_gsi_grid(text, "a.xml"), Error) << to;
  }
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    try {
      read_gsi_grid(std::string_view(whole).substr(0, size), "a.xml");
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("a.xml: ")) << error.what();
    }
  }
}

// A grid of 6 x 6 points, 10 m apart, whose heights say in which row from the north they lie. Words
// stand in the first `rows` of them.
std::string make_rows(const std::string& word, int rows, const std::string& head) {
  std::string text = "ncols 6\nnrows 6\nxllcorner 390995\nyllcorner 5818975\ncellsize 10\n" + head;
  for (int row = 1; row <= 6; ++row) {
    for (int column = 0; column < 6; ++column)
      text += (column > 0 ? " " : "") + (row <= rows ? word : std::to_string(row));
    text += "\n";
  }
  return text;
}

// GDAL 3.6 takes words for heights of 0, and passes over the first rows that begin with a letter,
// so that all others lie too far north.
TEST(TextRasters, WordsForUnknownHeightsAreHoles) {
  const TempFolder folder;
  for (const char* word : {"nan", "NaN", "NA", "null", "NULL", "nodata", "None", "N/A", "#N/A", "*",
                           "-", "---", "inf", "-nan", "nan(ind)", "1.#QNAN"})
    for (const char* head : {"", "NODATA_value -9999\n", "nodata_value NA\n"}) {
      const std::string what = std::string(word) + " below " + head;
      write_text(folder / "a.asc", make_rows(word, 2, head));
      EXPECT_NEAR(height_of(folder / "a.asc", place, "EPSG:25833"), 3, 1e-4) << what;
      write_text(folder / "a.asc", make_rows(word, 6, head));
      EXPECT_TRUE(std::isnan(height_of(folder / "a.asc", place, "EPSG:25833"))) << what;
    }
  std::string plane = make_plane();
  for (std::size_t at = 0; (at = plane.find("391020 5819010 37.5", at)) != std::string::npos;)
    plane.replace(at + 15, plane.find('\n', at) - at - 15, "NA");
  write_text(folder / "a.xyz", plane);
  EXPECT_TRUE(std::isnan(height_of(folder / "a.xyz", place, "EPSG:25833")));
}

TEST(TextRasters, WordsBeforeTheHeightsStay) {
  const TempFolder folder;
  for (const char* headings : {"x y z\n", "Easting,Northing,Height\n"}) {
    std::string plane = headings + make_plane();
    if (std::string(headings).find(',') != std::string::npos)
      std::replace(plane.begin(), plane.end(), ' ', ',');
    write_text(folder / "a.xyz", plane);
    EXPECT_NEAR(height_of(folder / "a.xyz", place, "EPSG:25833"), 37.5, 1e-4) << headings;
  }
}

TEST(TextRasters, ADefinitionBesideMayHaveAMarkOrBeAName) {
  const TempFolder folder;
  write_text(folder / "a.xyz", make_plane());
  const std::string esri =
      "PROJCS[\"ETRS_1989_UTM_Zone_33N\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\","
      "SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],PRIMEM[\"Greenwich\",0.0],"
      "UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
      "PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],"
      "PARAMETER[\"Central_Meridian\",15.0],PARAMETER[\"Scale_Factor\",0.9996],"
      "PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";
  for (const std::string& text :
       {esri, "\xef\xbb\xbf" + esri, to_wide(esri, false), std::string("EPSG:25833\n"),
        std::string("urn:ogc:def:crs:EPSG::25833"),
        std::string("+proj=utm +zone=33 +ellps=GRS80 +units=m")}) {
    write_text(folder / "a.prj", text);
    EXPECT_NEAR(height_of(folder / "a.xyz", place, ""), 37.5, 1e-4) << text.substr(0, 30);
  }
}

}  // namespace
}  // namespace nightcity::terrain
