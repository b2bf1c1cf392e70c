// Texts of tables in forms that spreadsheets, people and old programs write.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "support/temp_folder.h"
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

}  // namespace
}  // namespace nightcity::inventory
