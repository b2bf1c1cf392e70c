// Tables in JSON in other forms than a list of objects, and texts that are almost JSON.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/temp_folder.h"
#include "tests/tools/inventory/json_file.h"
#include "tools/inventory/look_at_table.h"

namespace nightcity::inventory {
namespace {

using test::TempFolder;
using test::write_text;

// The six orientations of pandas' to_json but for "values", which names no columns.
TEST(JsonForms, TablesMayLieByColumnsOrByTheNamesOfRows) {
  expect_two(R"({"id":{"0":"a","1":"b"},"lon":{"0":13.4,"1":13.41},"lat":{"0":52.5,"1":52.51}})");
  expect_two(R"({"0":{"lon":13.4,"lat":52.5},"1":{"lon":13.41,"lat":52.51}})");
  expect_two(R"({"columns":["lon","lat"],"index":[0,1],"data":[[13.4,52.5],[13.41,52.51]]})");
  expect_two(R"({"schema":{"fields":[{"name":"index","type":"integer"},{"name":"lon"},
                 {"name":"lat"}],"primaryKey":["index"],"pandas_version":"1.4.0"},
                 "data":[{"index":0,"lon":13.4,"lat":52.5},{"index":1,"lon":13.41,"lat":52.51}]})");
  expect_two(R"({"lon":[13.4,13.41],"lat":[52.5,52.51],"note":["a \"b\"",null]})");
  expect_two(R"({"status":"ok","data":{"lon":[13.4,13.41],"lat":[52.5,52.51]}})");
  // Firebase's, under their ids and in a member; and rows that columns name in different order.
  expect_two(R"({"lamps":{"-Ma":{"lat":52.5,"lng":13.4},"-Mb":{"lat":52.51,"lng":13.41}}})");
  expect_two(R"({"lat":{"a":52.5,"b":52.51},"lon":{"b":13.41,"a":13.4}})");
  expect_two(R"({"7":{"geometry":{"type":"Point","coordinates":[13.4,52.5]}},
                 "9":{"geometry":{"type":"Point","coordinates":[13.41,52.51]}}})",
             "");
}

TEST(JsonForms, NamesOfRowsAreAColumn) {
  const TempFolder folder;
  write_text(folder / "lamps.json", R"({"L-7":{"lon":13.4,"lat":52.5,"watt":60}})");
  const TableLook look = look_at_table(folder / "lamps.json");
  EXPECT_EQ(look.columns, (std::vector<std::string>{"index", "lon", "lat", "watt"}));
}

TEST(JsonForms, ObjectsThatAreNoTableAreNone) {
  for (const char* text :
       {R"({"meta":{"name":"x"},"about":{"name":"y"}})", R"({"lon":[13.4,13.41],"lat":[52.5]})",
        R"({"type":"CityJSON","CityObjects":{"a":{"type":"Building","geometry":[]}}})"})
    EXPECT_NE(why_no_json(text).find("no table of lamps"), std::string::npos) << why_no_json(text);
}

// Python, scripts and people write such for JSON.
TEST(JsonForms, TextsThatAreAlmostJsonAreRead) {
  const std::string a = R"({"lat":52.5,"lon":13.4,"h":NaN})", b = R"({"lat":52.51,"lon":13.41})";
  expect_two("[" + a + "," + b + "]");
  expect_two("[" + a + ",\n" + b + ",\n]");
  expect_two(a + "\n" + b + "\n");
  expect_two("{\"lat\":52.5,\n\"lon\":13.4}\n{\"lat\":52.51,\n\"lon\":13.41}\n");
  expect_two("// lamps, {2024}\n[" + a + ", /* the \"other\" */ " + b + "]");
  expect_two("callback([" + a + "," + b + "]);");
  expect_two("var lamps = [" + a + "," + b + "];\n");
  expect_two(R"([{"lat":52.5,"lon":13.4,"id":99999999999999999999999,"url":"http://a/,]"},)" + b +
             "]");
  expect_two(R"([{"lat":52.5,"lon":13.4,"a":-Infinity,"b":undefined,"c":[1,],"d":"NaN, // \"x"},)" +
             b + "]");
}

TEST(JsonForms, WhatStaysBrokenIsSaidToBe) {
  for (const char* text : {R"([{"lat":52.5,"lon":13.4})", R"([{"lat":52.5 "lon":13.4}])",
                           R"([{"lat":52.5,"lon":}])", "[{\"lat\":52.5,\"lon\":\"13.4}]"})
    EXPECT_NE(why_no_json(text).find("broken JSON"), std::string::npos) << why_no_json(text);
}

// Some of the rows would be lost without a word.
TEST(JsonForms, SeveralTablesAreRefused) {
  const std::string a = R"({"lon":13.4,"lat":52.5})", b = R"({"lon":13.41,"lat":52.51})";
  const std::string rows_a = R"({"1":)" + a + "}", rows_b = R"({"1":)" + b + "}";
  EXPECT_NE(why_no_json("var a = [" + a + "];\nvar b = [" + b + "];").find("broken JSON"),
            std::string::npos);
  EXPECT_NE(why_no_json("f([" + a + "]); f([" + b + "]);").find("broken JSON"), std::string::npos);
  EXPECT_NE(why_no_json(R"({"lamps":)" + rows_a + R"(,"poles":)" + rows_b + "}")
                .find("several tables (lamps, poles"),
            std::string::npos);
  EXPECT_NE(why_no_json(R"({"lamps":[)" + a + R"(],"poles":[)" + b + R"(],"center":)" + a + "}")
                .find("several lists"),
            std::string::npos);
}

TEST(JsonForms, TheMiddleOfAMapIsNoLamp) {
  expect_two(R"({"title":"x","center":{"lon":1,"lat":2},"lamps":{"a":{"lon":13.4,"lat":52.5},
                 "b":{"lon":13.41,"lat":52.51}}})");
  EXPECT_NE(why_no_json(R"({"title":"x","center":{"lon":1,"lat":2}})").find("no list of objects"),
            std::string::npos);
}

TEST(JsonForms, AColumnNamedIndexIsKept) {
  const TempFolder folder;
  write_text(folder / "lamps.json", R"({"L-7":{"lon":13.4,"lat":52.5,"index":60}})");
  EXPECT_EQ(look_at_table(folder / "lamps.json").columns,
            (std::vector<std::string>{"name", "lon", "lat", "index"}));
}

// Neither number tells which it is.
TEST(JsonForms, ListsOfTwoNumbersAreADoubt) {
  const auto doubt = [](const char* text) { return read_json_file(text).report.doubt; };
  EXPECT_NE(doubt(R"([{"location":[13.4,52.5]}])").find("longitude and latitude"),
            std::string::npos);
  EXPECT_EQ(doubt(R"([{"location":[139.7,35.6]}])"), "");
  EXPECT_EQ(doubt(R"([{"latlng":[52.5,13.4]}])"), "");
  EXPECT_EQ(read_json_file(R"([{"location":[35.6,139.7]}])").lamps.at(0).lon_lat,
            glm::dvec2(139.7, 35.6));
}

TEST(JsonForms, ASingleObjectWithAPlaceIsARow) {
  EXPECT_EQ(read_json_file(R"({"id":7,"lat":52.5,"lon":13.4})").lamps.size(), 1u);
  EXPECT_NE(why_no_json(R"({"id":7,"name":"x"})").find("no list of objects"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::inventory
