// Texts of tables in forms that spreadsheets, people and old programs write.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/gdal/utm_zone.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {
namespace {

using test::TempFolder;
using test::write_text;

Inventory read_csv(const TempFolder& folder, const std::string& name, const std::string& text) {
  write_text(folder / name, text);
  InventoryFile file;
  file.file = folder / name;
  file.crs = "EPSG:4326";
  return read_inventory(file);
}

// 13 degrees, 24 minutes, 36 seconds are 13.41 degrees. The marks opened and closed cells for GDAL.
TEST(CsvForms, MarksOfSecondsNeedNoQuotes) {
  const TempFolder folder;
  for (const char separator : {',', ';', '\t', '|'}) {
    std::string text =
        "id,note,lon,lat\n"
        "a,\"a \"\"good\"\" one\",13°24'00.0\",52°30'00\"\n"
        "b,5\" steel,13°24'36.0\",52°30'36\" N\n"
        "c,\"d, e\",\"13°25'12\"\"\",\"52°31'12\"\"\"\n";
    std::replace(text.begin(), text.end(), ',', separator);
    const Inventory read = read_csv(folder, separator == '\t' ? "lamps.tsv" : "lamps.csv", text);
    ASSERT_EQ(read.lamps.size(), 3u) << separator;
    EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.4, 1e-12) << separator;
    EXPECT_NEAR(read.lamps[1].lon_lat.x, 13.41, 1e-12) << separator;
    EXPECT_NEAR(read.lamps[1].lon_lat.y, 52.51, 1e-12) << separator;
    EXPECT_NEAR(read.lamps[2].lon_lat.y, 52.52, 1e-12) << separator;
  }
}

TEST(CsvForms, CommentsMayStandBeforeTheHeadings) {
  const TempFolder folder;
  for (const char* text :
       {"# source: X, CC BY\n# 2026\nid;lon;lat\na;13.4;52.5\n", "#id;lon;lat\na;13.4;52.5\n"})
    EXPECT_EQ(read_csv(folder, "lamps.csv", text).lamps.size(), 1u) << text;
}

TEST(CsvForms, OneColumnIsATable) {
  const TempFolder folder;
  const Inventory read = read_csv(folder, "lamps.csv", "location\n52.5, 13.4\n\"52.51, 13.41\"\n");
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5));
  EXPECT_EQ(read.lamps[1].lon_lat, glm::dvec2(13.41, 52.51));
}

// Each letter of Latin text and a zero, whichever is first.
TEST(CsvForms, ZerosInEverySecondPlaceAreUtf16) {
  const TempFolder folder;
  for (const bool big_endian : {false, true})
    for (const auto& [name, text] :
         {std::pair<const char*, std::string>{"a.csv",
                                              "Stra\xdf"
                                              "e,lon,lat\nA,13.4,52.5\n"},
          std::pair<const char*, std::string>{
              "a.geojson",
              R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
              R"("geometry":{"type":"Point","coordinates":[13.4,52.5]}}]})"}}) {
      std::string wide;
      for (const char c : text) {
        if (big_endian) wide += '\0';
        wide += c;
        if (!big_endian) wide += '\0';
      }
      const Inventory read = read_csv(folder, name, wide);
      ASSERT_EQ(read.lamps.size(), 1u) << name << big_endian;
      EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << name << big_endian;
    }
}

struct Titled {
  const char* text;
  std::size_t titles;
  std::size_t lamps = 1;
  std::size_t without_place = 0;
};

TEST(CsvForms, TitlesMayStandAboveTheHeadings) {
  const TempFolder folder;
  const Titled tables[] = {
      {"Street lights\n\nid;lon;lat\na;13.4;52.5\n", 1},
      {"Street lights;;\n;;\nid;lon;lat\na;13.4;52.5\n", 2},
      {"Lamps, Town of X, 2024, final\nid,lon,lat\na,13.4,52.5\n", 1},
      {"\xef\xbb\xbfLamps\r\nSource:,X\r\n\r\nid,lon,lat\r\na,13.4,52.5\r\n", 2},
      {"sep=;\nLamps;;\nid;lon;lat\na;13.4;52.5\n", 1},
      {"\"Lamps\nof X\"\nid\tlon\tlat\na\t13.4\t52.5\n", 1},
      {"Lamps\nid|lon|lat\na|13.4|52.5\n", 1},
      {";Place;\nid;lon;lat\n;degrees;degrees\na;13.4;52.5\nTotal;;\n", 1, 1, 2},
      {"Lamps\nid;location\na;52.5, 13.4\n", 1},
      {"Lamps\nid;WKT\na;POINT(13.4 52.5)\n", 1},
      {"id;lon;lat\na;13.4;52.5\nStand: 2024\n", 0, 1, 1},
      // Values that are names of coordinates are no headings.
      {"id;Shape;from;to\na;POINT(13.4 52.5);E;N\n", 0},
  };
  for (const Titled& table : tables) {
    for (const char* name : {"lamps.csv", "lamps.tsv"}) {
      try {
        const Inventory read = read_csv(folder, name, table.text);
        ASSERT_EQ(read.lamps.size(), table.lamps) << table.text;
        EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << table.text;
        EXPECT_EQ(read.report.titles, table.titles) << table.text;
        const auto skipped = read.report.skipped.find("without a place");
        EXPECT_EQ(skipped == read.report.skipped.end() ? 0 : skipped->second, table.without_place)
            << table.text;
      } catch (const Error& error) {
        ADD_FAILURE() << table.text << "\n" << error.what();
      }
    }
  }
}

TEST(CsvForms, HeadingsThatTheRecipeNamesAreFoundBelowTitles) {
  const TempFolder folder;
  write_text(folder / "lamps.csv", "Lamps 2024;;\nid;Ort_a;Ort_b\na;13.4;52.5\n");
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  file.x = "Ort_a";
  file.y = "Ort_b";
  const Inventory read = read_inventory(file);
  EXPECT_EQ(read.lamps.at(0).lon_lat, glm::dvec2(13.4, 52.5));
  EXPECT_EQ(read.report.titles, 1u);
}

// The same headings in UTF-8 and in what older programs of the country write.
TEST(CsvForms, HeadingsTellTheEncoding) {
  const TempFolder folder;
  const std::pair<const char*, std::string> tables[] = {
      {"CP932", "\x94\xd4\x8d\x86,\x8c\x6f\x93\x78,\x88\xdc\x93\x78\r\n"},  // 番号,経度,緯度
      {"CP1251", "\xcd\xee\xec\xe5\xf0,\xc4\xee\xeb\xe3\xee\xf2\xe0,\xd8\xe8\xf0\xee\xf2\xe0\r\n"},
      {"CP949", "\xb9\xf8\xc8\xa3,\xb0\xe6\xb5\xb5,\xc0\xa7\xb5\xb5\r\n"},  // 번호,경도,위도
      {"", "番号,経度,緯度\r\n"},
      {"",
       "Stra\xdf"
       "e,lon,lat\r\n"}};
  for (const auto& [encoding, headings] : tables) {
    const Inventory read = read_csv(folder, "lamps.csv", headings + "a,13.4,52.5\r\n");
    ASSERT_EQ(read.lamps.size(), 1u) << headings;
    EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << headings;
    EXPECT_EQ(read.report.encoding, encoding) << headings;
  }
}

// Nothing names the encoding of cells, and letters of another would be wrong ones.
TEST(CsvForms, ValuesThatAreNoUtf8AreSaid) {
  const TempFolder folder;
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  file.columns["model"] = "type";
  for (const char* type : {"Leuchte \xe4", "Leuchte \xc3\xa4"}) {
    write_text(file.file, "id,lon,lat,type\na,13.4,52.5," + std::string(type) + "\n");
    const Inventory read = read_inventory(file);
    EXPECT_EQ(read.report.encoding, type[8] == '\xe4' ? "Windows-1252" : "");
    EXPECT_EQ(read.lamps.at(0).tags.at("luminaire_model"), "Leuchte ä");
  }
}

std::string to_utf16(std::u16string_view text, bool big_endian) {
  std::string out;
  for (const char16_t unit : text) {
    const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
    out += big_endian ? high : low;
    out += big_endian ? low : high;
  }
  return out;
}

TEST(CsvForms, Utf16WithoutAMarkMayBeginInAnyScript) {
  const TempFolder folder;
  for (const std::u16string_view text :
       {u"Долгота;Широта\r\n13.4;52.5\r\n", u"経度,緯度\n13.4,52.5\n",
        u"番号　一,経度,緯度\na,13.4,52.5\n", u"Φανάρια\n\nlon;lat\n13.4;52.5\n",
        u"경도\t위도\n13.4\t52.5\n"})
    for (const bool big_endian : {false, true}) {
      try {
        const Inventory read = read_csv(folder, "lamps.csv", to_utf16(text, big_endian));
        ASSERT_EQ(read.lamps.size(), 1u) << big_endian;
        EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << big_endian;
      } catch (const Error& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

// A point at 13.4 E, 52.5 N.
TEST(CsvForms, GeometriesMayBeTextsInAnyForm) {
  const TempFolder folder;
  const char* const hex = "0101000000CDCCCCCCCCCC2A400000000000404A40";
  const char* const hex_of_4326 = "0101000020E6100000CDCCCCCCCCCC2A400000000000404A40";
  const char* const big_hex = "0000000001402ACCCCCCCCCCCD404A400000000000";
  const char* const geojson = R"("{""type"": ""Point"", ""coordinates"": [13.4, 52.5]}")";
  const char* const feature =
      R"("{""type"":""Feature"",""geometry"":{""type"":""Point"",""coordinates"":[13.4,52.5]}}")";
  const char* const geometries[] = {"POINT(13.4 52.5)",
                                    "Point Z (13.4 52.5 30)",
                                    "SRID=4326;POINT(13.4 52.5)",
                                    "MULTIPOINT((13.4 52.5))",
                                    hex,
                                    hex_of_4326,
                                    "0x0101000000CDCCCCCCCCCC2A400000000000404A40",
                                    "\\x0101000000CDCCCCCCCCCC2A400000000000404A40",
                                    feature,
                                    big_hex,
                                    geojson};
  for (const char* heading : {"geometry", "wkt", "shape", "wkb_geometry", "geojson", "lamp place"})
    for (const char* geometry : geometries) {
      try {
        const Inventory read =
            read_csv(folder, "lamps.csv", std::string("id|") + heading + "\na|" + geometry + "\n");
        ASSERT_EQ(read.lamps.size(), 1u) << heading << " " << geometry;
        EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << heading << " " << geometry;
      } catch (const Error& error) {
        ADD_FAILURE() << heading << " " << geometry << "\n" << error.what();
      }
    }
}

TEST(CsvForms, SpreadsheetsWriteFormulasAndHeadingsOfSeveralLines) {
  const TempFolder folder;
  for (const char* text :
       {"id,lon,lat\n=\"007\",=\"13.4\",=\"52.5\"\n", "id;lon;lat\na;=\"13,4\";=\"52,5\"\n",
        "\"id\",\"lon\n(deg)\",\"lat\r\n(deg)\"\na,13.4,52.5\n",
        "Lamps\n\"id\",\"lon\n(deg)\",\"lat\n(deg)\"\n\"a\nb\",13.4,52.5\n"}) {
    const Inventory read = read_csv(folder, "lamps.csv", text);
    ASSERT_EQ(read.lamps.size(), 1u) << text;
    EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << text;
  }
}

// Lists are written as JSON has them; pairs in words have latitude first.
TEST(CsvForms, ListsOfTwoNumbersAreReadByTheNameOfTheirColumn) {
  const TempFolder folder;
  for (const char* text : {"id;coordinates\na;[13.4, 52.5]\n", "id;location\na;\"[13.4,52.5]\"\n",
                           "id;location\na;(52.5, 13.4)\n", "id;geo_point_2d\na;[52.5, 13.4]\n",
                           "id;latlng\na;[52.5, 13.4]\n", "id;location\na;52.5, 13.4\n"}) {
    const Inventory read = read_csv(folder, "lamps.csv", text);
    ASSERT_EQ(read.lamps.size(), 1u) << text;
    EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << text;
  }
}

// 391020, 5819010 of EPSG:25833.
TEST(CsvForms, EastingsMayBeginWithTheirZone) {
  const TempFolder folder;
  InventoryFile file;
  file.file = folder / "lamps.csv";
  for (const auto& [east, crs] : {std::pair{"391020", "EPSG:25833"},
                                  {"33391020", "EPSG:25833"},
                                  {"33391020", "EPSG:5650"},
                                  {"33391020", "EPSG:32633"}}) {
    write_text(file.file, std::string("id;x;y\na;") + east + ";5819010\n");
    file.crs = crs;
    const Inventory read = read_inventory(file);
    EXPECT_NEAR(read.lamps.at(0).lon_lat.x, 13.394162598, 1e-7) << east << crs;
    EXPECT_NEAR(read.lamps.at(0).lon_lat.y, 52.510303463, 1e-7) << east << crs;
  }
  write_text(file.file, "id;x;y\na;32391020;5819010\n");
  file.crs = "EPSG:25833";
  EXPECT_THROW(read_inventory(file), Error) << "of another zone";
  // In Anchorage a northing begins as an easting behind its zone would.
  write_text(file.file, "id;x;y\na;6790000;345000\n");
  file.crs = "EPSG:32606";
  EXPECT_NE(read_inventory(file).report.doubt.find("outside of the area"), std::string::npos);
  EXPECT_EQ(gdal::take_zone_off(6'790'000, 6), 6'790'000);
  EXPECT_EQ(gdal::take_zone_off(10'345'000, 10), 345'000);
}

}  // namespace
}  // namespace nightcity::inventory
