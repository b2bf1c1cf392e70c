// Rows in JSON that is no GeoJSON, as the servers of portals answer, with the places they mean.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tests/tools/inventory/json_file.h"
#include "tools/inventory/look_at_table.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {
namespace {

using test::TempFolder;
using test::write_text;

TEST(JsonTable, AListOfObjectsIsATable) {
  expect_two(two_rows);
  expect_two("\xef\xbb\xbf" + std::string(two_rows));
  EXPECT_NE(why_no_json(two_rows, "").find("names no CRS"), std::string::npos)
      << "as a CSV with the same columns";
  expect_two(R"([["id","lat","lon"],["a",52.5,13.4],["b",52.51,13.41]])");
  expect_two("{\"lat\":52.5,\"lon\":13.4}\r\n\r\n{\"lat\":52.51,\"lon\":13.41}\r\n");
}

TEST(JsonTable, SocratasRowsHavePlacesInThreeForms) {
  expect_two(R"([{"location":{"latitude":"52.5","longitude":"13.4"}},
                 {"location":{"latitude":"52.51","longitude":"13.41"}}])");
  expect_two(R"([{"the_geom":{"type":"Point","coordinates":[13.4,52.5]}},
                 {"the_geom":{"type":"Point","coordinates":[13.41,52.51]}}])",
             "");
  expect_two(R"({"meta":{"view":{"columns":[{"fieldName":":sid"},{"fieldName":"location",
                 "subColumnTypes":["human_address","latitude","longitude"]}]}},
                 "data":[["r1",["{}","52.5","13.4"]],["r2",["{}","52.51","13.41"]]]})");
}

TEST(JsonTable, OpenDataSoftsRowsHavePlacesInFourForms) {
  expect_two(R"({"total_count":2,"results":[{"geo_point_2d":{"lon":13.4,"lat":52.5}},
                 {"geo_point_2d":{"lon":13.41,"lat":52.51}}]})");
  expect_two(R"([{"geo_point_2d":[52.5,13.4]},{"geo_point_2d":[52.51,13.41]}])");
  expect_two(R"({"nhits":2,"records":[
      {"fields":{"geo_point_2d":[52.5,13.4]},"geometry":{"type":"Point","coordinates":[13.4,52.5]}},
      {"fields":{},"geometry":{"type":"Point","coordinates":[13.41,52.51]}}]})",
             "");
  expect_two(
      R"([{"geo_shape":{"type":"Feature","geometry":{"type":"Point","coordinates":[13.4,52.5]}}},
                 {"geo_shape":{"type":"Feature",
                  "geometry":{"type":"Point","coordinates":[13.41,52.51]}}}])",
      "");
}

TEST(JsonTable, ArcGisAnswersNameTheirSystem) {
  expect_two(R"({"features":[{"attributes":{"ID":1},"geometry":{"x":13.4,"y":52.5}},
                 {"attributes":{"ID":2},"geometry":{"x":13.41,"y":52.51}}],
                 "spatialReference":{"wkid":4326}})",
             "");
  // R ln tan(45 + 52.5 / 2 degrees) and 13.4 pi R / 180, R = 6378137 m.
  const Inventory web = read_json_file(
      R"({"features":[{"attributes":{"ID":1},"geometry":{"x":1491681.1766,"y":6891041.7243}}],
          "spatialReference":{"wkid":102100,"latestWkid":3857}})",
      "");
  EXPECT_NEAR(web.lamps.at(0).lon_lat.x, 13.4, 1e-7);
  EXPECT_NEAR(web.lamps.at(0).lon_lat.y, 52.5, 1e-7);
}

TEST(JsonTable, RowsAreFoundInWhatWrapsThem) {
  const std::string rows = two_rows;
  for (const std::string start :
       {R"({"success":true,"result":{"total":2,"_links":{"next":"/b"},"records":)",
        R"({"_embedded":{"lamps":)"})
    expect_two(start + rows + "}}");
  for (const char* key : {"value", "data", "items", "lamps"})
    expect_two("{\"" + std::string(key) + "\":" + rows + ",\"next\":null}");
  expect_two(R"({"response":{"header":{},"body":{"items":{"item":)" + rows +
             R"(},"totalCount":2}}})");
  expect_two(R"({"hits":{"hits":[{"_id":"a","_source":{"location":{"lat":52.5,"lon":13.4}}},
                 {"_id":"b","_source":{"location":{"lat":52.51,"lon":13.41}}}]}})");
  expect_two(R"({"head":{},"results":{"bindings":[{"p":{"value":"Point(13.4 52.5) "
}
},
                 {"p":{"value":"Point(13.41 52.51) "}}]
}
})");
  expect_two(R"({"fields":[{"id":"lat"},{"id":"lon"}],"records":[[52.5,13.4],[52.51,13.41]]})");
}

TEST(JsonTable, FeaturesMayBeAListOfTheirOwn) {
  const std::string a = R"({"type":"Feature","properties":{},
               "geometry":{"type":"Point","coordinates":[13.4,52.5]}})",
                    b = R"({"type":"Feature","properties":{},
               "geometry":{"type":"Point","coordinates":[13.41,52.51]}})";
  expect_two("[" + a + "," + b + "]", "");
  expect_two(R"([{"type":"FeatureCollection","features":[)" + a + R"(]},{"features":[)" + b + "]}]",
             "");
}

// Positions have longitude first, texts and OpenDataSoft's points latitude.
TEST(JsonTable, PairsOfNumbersAreReadByWhoWritesThem) {
  expect_two(R"([{"coordinates":[13.4,52.5]},{"coordinates":[13.41,52.51]}])");
  expect_two(R"([{"latlng":[52.5,13.4]},{"latlng":[52.51,13.41]}])");
  expect_two(R"([{"location":"52.5, 13.4"},{"location":"52.51, 13.41"}])");
}

TEST(JsonTable, ValuesAreThoseOfTheColumnsThatARecipeNames) {
  const TempFolder folder;
  write_text(folder / "lamps.json",
             R"([{"pole":{"id":"a"},"lat":52.5,"lon":13.4,"W":70,"H":8.5,"on":false},
                 {"pole":{"id":"b"},"lat":52.51,"lon":13.41,"W":null,"note":"a \"b\", c;\nd"}])");
  InventoryFile file;
  file.file = folder / "lamps.json";
  file.crs = "EPSG:4326";
  file.id = "pole.id";
  file.columns = {{"watts", "W"}, {"height", "H"}, {"state", "on"}, {"model", "note"}};
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.lamps[0].tags,
            (osm::OsmTags{{"light:power", "70"}, {"height", "8.5"}, {"operational_status", "no"}}));
  EXPECT_EQ(read.lamps[1].tags, (osm::OsmTags{{"luminaire_model", "a \"b\", c;\nd"}}));
}

TEST(JsonTable, LettersMayBeThoseOfWindows) {
  const TempFolder folder;
  write_text(folder / "a.json",
             "[{\"Stra\xdf"
             "e\":\"x\",\"lat\":52.5,\"lon\":13.4}]");
  InventoryFile file;
  file.file = folder / "a.json";
  file.crs = "EPSG:4326";
  file.id =
      "Stra\xc3\x9f"
      "e";
  EXPECT_EQ(read_inventory(file).lamps.size(), 1u);
}

TEST(JsonTable, RowsWithoutAPlaceAreCounted) {
  const Inventory read = read_json_file(R"([{"lat":52.5,"lon":13.4},{"lat":null},{}])");
  EXPECT_EQ(read.report.rows, 3u);
  EXPECT_EQ(read.report.skipped.at("without a place"), 2u);
}

TEST(JsonTable, RowsThatTheServerDidNotSendAreTold) {
  const auto incomplete = [](const std::string& beside) {
    return read_json_file("{" + beside + "\"results\":" + two_rows + "}").report.incomplete;
  };
  for (const char* total : {"total_count", "nhits", "total", "count", "numFound", "@odata.count"})
    EXPECT_NE(incomplete("\"" + std::string(total) + "\":500,").find("2 of its 500"),
              std::string::npos)
        << total;
  for (const char* next :
       {R"("next":"https://a/?page=2",)", R"("@odata.nextLink":"https://a",)",
        R"("links":[{"rel":"next"}],)", R"("paging":{"next":{"href":"https://a"}},)"})
    EXPECT_NE(incomplete(next).find("one page"), std::string::npos) << next;
  EXPECT_NE(incomplete(R"("exceededTransferLimit":true,)").find("exceededTransferLimit"),
            std::string::npos);
  for (const char* whole :
       {R"("next":null,)", R"("next":"",)", R"("total":2,)", R"("exceededTransferLimit":false,)"})
    EXPECT_EQ(incomplete(whole), "") << whole;
}

// Socrata sends a thousand rows unless asked for more, and does not say so.
TEST(JsonTable, ExactlyAThousandRowsMayBeAPage) {
  const auto incomplete = [](int rows) {
    std::string text;
    for (int i = 0; i < rows; ++i)
      text += (i > 0 ? "," : "[") + std::string("{\"lat\":52.5,\"lon\":") +
              std::to_string(13 + i * 1e-4) + "}";
    return read_json_file(text + "]").report.incomplete;
  };
  EXPECT_NE(incomplete(1000).find("$limit"), std::string::npos);
  EXPECT_EQ(incomplete(999), "");
  EXPECT_EQ(incomplete(1001), "");
}

TEST(JsonTable, WhatIsNoTableIsNamed) {
  EXPECT_NE(why_no_json("[]").find("has no row"), std::string::npos);
  EXPECT_NE(why_no_json("[1,2]").find("not of objects"), std::string::npos);
  EXPECT_NE(why_no_json(R"([{"lat":52.5,"lon":13.4},{"lat":)").find("broken JSON"),
            std::string::npos);
  EXPECT_NE(why_no_json("{\"lat\":52.5,\"lon\":13.4}\n{\"lat\":").find(":2: is broken JSON"),
            std::string::npos);
  EXPECT_NE(
      why_no_json(R"({"lamps":[{"a":1}],"poles":[{"a":1}]})").find("lists of objects: lamps poles"),
      std::string::npos);
  EXPECT_NE(why_no_json(R"([{"a":1}])").find("no columns with coordinates"), std::string::npos);
  EXPECT_NE(why_no_json(std::string(2000, '[') + std::string(2000, ']')).find("JSON"),
            std::string::npos);
}

// The member named crs by GDAL's rules has the name of one; PROJJSON and a text were WGS 84 to it.
TEST(JsonTable, TheCrsOfAGeoJsonMayBePROJJSONOrAText) {
  const auto place = [](const std::string& before, const std::string& of_row) {
    const Inventory read = read_json_file(
        "{" + before +
            R"("type":"FeatureCollection","features":[{"type":"Feature","properties":{)" + of_row +
            R"(},"geometry":{"type":"Point","coordinates":[391020,5819010]}}]})",
        "");
    return read.lamps.at(0).lon_lat;
  };
  for (const char* system :
       {R"("EPSG:25833")",
        R"({"type":"ProjectedCRS","name":"x","id":{"authority":"EPSG","code":25833}})",
        R"({"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25833"}})"}) {
    const std::string crs = "\"crs\":" + std::string(system);
    EXPECT_NEAR(place(crs + ",", R"("crs":"EPSG:3857")").x, 13.394162598, 1e-7) << system;
    EXPECT_NEAR(place(crs + ",", "").y, 52.510303463, 1e-7) << system;
  }
  const Inventory degrees = read_json_file(
      R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":{"type":"Point",
          "coordinates":[13.4,52.5]},"properties":{"crs":"EPSG:3857"}}]})",
      "");
  EXPECT_EQ(degrees.lamps.at(0).lon_lat, glm::dvec2(13.4, 52.5)) << "a row's own column";
}

TEST(JsonTable, ItsColumnsAreGuessedAsThoseOfOtherTables) {
  const TempFolder folder;
  write_text(folder / "lamps.json", R"([{"POLE_ID":"a","lat":52.5,"lon":13.4,"Wattage":70}])");
  const TableLook look = look_at_table(folder / "lamps.json");
  EXPECT_TRUE(look.has_points && look.speaks_of_lamps);
  EXPECT_EQ(look.format, "JSON");
  const InventoryFile guess = guess_inventory(folder / "lamps.json", look);
  EXPECT_EQ(guess.id, "POLE_ID");
  EXPECT_EQ(guess.columns.at("watts"), "Wattage");
}

}  // namespace
}  // namespace nightcity::inventory
