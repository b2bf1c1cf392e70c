// Signs that programs and people leave in tables: quotation marks, units, what nobody sees.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/temp_folder.h"
#include "tools/inventory/coordinate_columns.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {
namespace {

using test::TempFolder;
using test::write_text;

std::vector<glm::dvec2> places_of(const std::string& text, const std::string& crs = "EPSG:4326",
                                  const std::string& name = "lamps.csv",
                                  const std::string& prj = "") {
  const TempFolder folder;
  write_text(folder / name, text);
  if (!prj.empty()) write_text(folder / prj, "EPSG:4326");
  InventoryFile file;
  file.file = folder / name;
  file.crs = crs;
  std::vector<glm::dvec2> places;
  for (const osm::OsmLampNode& lamp : read_inventory(file).lamps) places.push_back(lamp.lon_lat);
  return places;
}

void expect_places(const std::vector<glm::dvec2>& read, const std::vector<glm::dvec2>& expected,
                   const std::string& what) {
  ASSERT_EQ(read.size(), expected.size()) << what;
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(read[i].x, expected[i].x, 1e-6) << what;
    EXPECT_NEAR(read[i].y, expected[i].y, 1e-6) << what;
  }
}

TEST(StraySigns, TheMinusOfTypographyIsAMinus) {
  for (const char* minus : {"-", "\xe2\x88\x92", "\xe2\x80\x93", "\xe2\x80\x91", "－"})
    expect_places(
        places_of(std::string("lon,lat\n") + minus + "0.1276,51.5072\n" + minus + "0.13,51.51\n"),
        {{-0.1276, 51.5072}, {-0.13, 51.51}}, minus);
}

TEST(StraySigns, WhatNobodySeesIsPassedOver) {
  for (const char* mark : {"\xe2\x80\x8e", "\xe2\x80\x8b", "\xc2\xa0", "\xef\xbb\xbf"})
    expect_places(
        places_of(std::string("lon,lat\n") + mark + "13.4,52.5" + mark + "\n" + "13.41,52.505\n"),
        {{13.4, 52.5}, {13.41, 52.505}}, mark);
  expect_places(places_of("lon,lat\n１３.４,５２.５\n"), {{13.4, 52.5}}, "wide digits");
}

TEST(StraySigns, MetresMayStandBehindCoordinates) {
  const auto read =
      places_of("x,y\n391403.30 m,5817859.10 m\n391403.30m,5817859.10m\n", "EPSG:25833");
  ASSERT_EQ(read.size(), 1u);  // rows at one place
  EXPECT_NEAR(read[0].x, 13.40, 0.01);
  EXPECT_NEAR(read[0].y, 52.50, 0.01);
}

// GDAL would take all from one such mark to the next for one cell, also where it first stands far
// behind the beginning.
TEST(StraySigns, QuotationMarksWithinQuotedCells) {
  for (const int before : {0, 2000}) {
    std::string text = "id,note,lon,lat\n";
    std::vector<glm::dvec2> expected;
    const auto add = [&](const std::string& note) {
      expected.emplace_back(13 + 0.0001 * static_cast<double>(expected.size()), 52.5);
      text += "1," + note + "," + std::to_string(expected.back().x) + ",52.5\n";
    };
    for (int i = 0; i < before; ++i) add("plain");
    for (const char* note : {"\"pole 5\" steel\"", "ok", "\"a \\\"big\\\" pole, old\"",
                             "\"a \"\"good\"\" one\"", "ok", "\"6\" wide\""})
      add(note);
    expect_places(places_of(text), expected, std::to_string(before));
  }
}

TEST(StraySigns, LongitudesATurnTooLargeAreTurnedBack) {
  expect_places(places_of("lon,lat\n373.4,52.5\n-346.6,52.51\n733.4,52.52\n"),
                {{13.4, 52.5}, {13.4, 52.51}, {13.4, 52.52}}, "turns");
}

TEST(StraySigns, ZeroAndZeroIsNoPlace) {
  const TempFolder folder;
  write_text(folder / "a.csv", "lon,lat\n13.4,52.5\n0,0\n0.0,0.00\n0,52.5\n");
  InventoryFile file;
  file.file = folder / "a.csv";
  file.crs = "EPSG:4326";
  const Inventory read = read_inventory(file);
  EXPECT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.report.skipped.at("at 0, 0, as programs write that know no place"), 2u);
}

TEST(StraySigns, PointsOfKmlInACell) {
  expect_places(places_of("id,geometry\n"
                          "1,\"<Point><coordinates>13.4,52.5,0</coordinates></Point>\"\n"
                          "2,\"<Point><coordinates>13.41,52.505</coordinates></Point>\"\n"),
                {{13.4, 52.5}, {13.41, 52.505}}, "KML");
}

TEST(StraySigns, ADefinitionLiesBesideACsv) {
  const std::string text = "x,y\n13.4,52.5\n";
  expect_places(places_of(text, "", "a.csv", "a.prj"), {{13.4, 52.5}}, "small");
  expect_places(places_of(text, "", "A.CSV", "A.PRJ"), {{13.4, 52.5}}, "capitals");
  expect_places(places_of("sep=,\n" + text, "", "a.csv", "a.prj"), {{13.4, 52.5}}, "odd");
}

// All rows are placed by one CRS.
TEST(StraySigns, RowsOfAnotherZoneAreADoubt) {
  const TempFolder folder;
  const auto doubt_of = [&](const std::string& heading, const std::string& zone) {
    write_text(folder / "a.csv", "id," + heading + ",easting,northing\n1,33U,391403,5817859\n2," +
                                     zone + ",391503,5817859\n");
    InventoryFile file;
    file.file = folder / "a.csv";
    file.crs = "EPSG:25833";
    return read_inventory(file).report.doubt;
  };
  EXPECT_EQ(doubt_of("zone", "33N"), "");
  EXPECT_NE(doubt_of("UTM zone", "32").find("1 of its rows name another zone of UTM (32)"),
            std::string::npos);
  EXPECT_NE(doubt_of("huso", "32U").find("than its CRS has (33)"), std::string::npos);
  EXPECT_EQ(doubt_of("zone", "4"), "") << "a district";
  EXPECT_EQ(doubt_of("zone", "North 4"), "");
  EXPECT_EQ(doubt_of("district", "32"), "");
}

TEST(StraySigns, HeadingsOfZonesAndDegrees) {
  const auto finds = [](const std::vector<std::string>& names) {
    const CoordinateColumns found = find_coordinate_columns(names);
    return found.x == 1 && found.y == 2;
  };
  EXPECT_TRUE(finds({"id", "Easting_ETRS89_UTM33", "Northing_ETRS89_UTM33"}));
  EXPECT_TRUE(finds({"id", "X_UTM32N", "Y_UTM32N"}));
  EXPECT_TRUE(finds({"id", "Länge (°)", "Breite (°)"}));
  EXPECT_FALSE(finds({"id", "Länge", "Breite"}));
  EXPECT_FALSE(finds({"id", "x1", "y1"}));
}

}  // namespace
}  // namespace nightcity::inventory
