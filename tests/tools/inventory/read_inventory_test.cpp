// Inventories of lamps in every format that is read, with known content.
#include "tools/inventory/read_inventory.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <functional>
#include <tuple>

#include "formats/error.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/add_to_map.h"
#include "tools/inventory/look_at_table.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::inventory {
namespace {

using namespace test;

const char* three_lamps = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"ID":"a","HT":30,"W":"70 W","LAMP":"HPS"},"geometry":{"type":"Point","coordinates":[13.4,52.5]}},
{"type":"Feature","properties":{"ID":"b","HT":null,"W":40,"LAMP":"FL"},"geometry":{"type":"Point","coordinates":[13.401,52.5]}},
{"type":"Feature","properties":{"ID":"c"},"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}},
{"type":"Feature","properties":{"ID":"d"},"geometry":null}]})";

InventoryFile make_file(const std::filesystem::path& path) {
  InventoryFile file;
  file.file = path;
  file.columns = {{"height", "HT"}, {"watts", "W"}, {"type", "LAMP"}};
  file.id = "ID";
  return file;
}

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Inventory, ColumnsOfPlacesHaveNamesInManyLanguages) {
  const TempFolder folder;
  for (const char* names :
       {"geo_lon,geo_lat", "lon_wgs84,lat_wgs84", "dlugosc,szerokosc",
        "d\u0142ugo\u015b\u0107,szeroko\u015b\u0107", "zem_delka,zem_sirka", "x_4326,y_4326"}) {
    write_text(folder / "lamps.csv", std::string(names) + ",HT\n13.4,52.5,8\n");
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:4326";
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 1u) << names;
    EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << names;
  }
}

TEST(Inventory, ColumnsMayBeSeparatedByBars) {
  const TempFolder folder;
  for (const std::string start : {"", "\xef\xbb\xbf", "sep=|\n"}) {
    write_text(folder / "lamps.csv", start +
                                         "ID|lon|lat|HT|W|LAMP|note\n"
                                         "a|13.4|52.5|8,5|70|HPS|\"one|two\"\n"
                                         "b|13.401|52.5||40|LED|a;b\n");
    InventoryFile file = make_file(folder / "lamps.csv");
    file.crs = "EPSG:4326";
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 2u);
    EXPECT_EQ(read.lamps[0].tags,
              (osm::OsmTags{{"height", "8,5"}, {"light:power", "70"}, {"lamp_type", "HPS"}}));
    EXPECT_EQ(read.lamps[1].lon_lat, glm::dvec2(13.401, 52.5));
  }
}

TEST(Inventory, ColumnsBecomeTheTagsThatLampsAreReadBy) {
  const TempFolder folder;
  write_text(folder / "lamps.geojson", three_lamps);
  InventoryFile file = make_file(folder / "lamps.geojson");
  file.feet = true;
  file.values["type"]["FL"] = "fluorescent";
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.lamps[0].tags,
            (osm::OsmTags{{"height", "30 ft"}, {"light:power", "70 W"}, {"lamp_type", "HPS"}}));
  EXPECT_EQ(read.lamps[1].tags,
            (osm::OsmTags{{"light:power", "40"}, {"lamp_type", "fluorescent"}}));
  EXPECT_NEAR(read.lamps[1].lon_lat.x, 13.401, 1e-9);
  EXPECT_NEAR(read.lamps[1].lon_lat.y, 52.5, 1e-9);
  EXPECT_TRUE(read.lamps[0].is_inventory);
  EXPECT_NE(read.lamps[0].id, read.lamps[1].id);
  EXPECT_EQ(read.report.rows, 4u);
  EXPECT_EQ(read.report.format, "GeoJSON");
  EXPECT_EQ(read.report.skipped.at("whose geometry is no point"), 1u);
  EXPECT_EQ(read.report.skipped.at("without a place"), 1u);
  EXPECT_EQ(read.report.columns.at("watts"), 2u);
  EXPECT_EQ(read.report.columns.at("height"), 1u);
}

TEST(Inventory, ACommaInADirectionIsADecimalOneUnlessThreeDigitsFollow) {
  const TempFolder folder;
  write_text(folder / "lamps.csv",
             "lon;lat;azimuth\n13.4;52.5;123,45\n13.41;52.5;90,270\n13.42;52.5;90;\n");
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  file.columns = {{"direction", "azimuth"}};
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 3u);
  EXPECT_EQ(read.lamps[0].tags.at("light:direction"), "123.45");
  EXPECT_EQ(read.lamps[1].tags.at("light:direction"), "90,270");
  EXPECT_EQ(read.lamps[2].tags.at("light:direction"), "90");
}

TEST(Inventory, AHeadingNamesTheUnitOfItsNumbers) {
  const TempFolder folder;
  write_text(folder / "lamps.csv",
             "lon,lat,Mounting height (ft),Flux [klm],POWER_KW,Works\n"
             "13.4,52.5,26,4.5,0.07,false\n13.41,52.5,8 m,4500 lm,70 W,true\n");
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  file.columns = {{"height", "Mounting height (ft)"},
                  {"lumens", "Flux [klm]"},
                  {"watts", "POWER_KW"},
                  {"state", "Works"}};
  EXPECT_EQ(guess_inventory(file.file, look_at_table(file.file)).columns.at("height"),
            "Mounting height (ft)");
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.lamps[0].tags, (osm::OsmTags{{"height", "26 ft"},
                                              {"light:lumens", "4.5 klm"},
                                              {"light:power", "0.07 kW"},
                                              {"operational_status", "false"}}));
  EXPECT_EQ(read.lamps[1].tags, (osm::OsmTags{{"height", "8 m"},
                                              {"light:lumens", "4500 lm"},
                                              {"light:power", "70 W"},
                                              {"operational_status", "true"}}));
  for (const auto& [heading, value, text] : {std::tuple("HeightFeet", "30", "30 ft"),
                                             {"MOUNT_HT_FT", "30", "30 ft"},
                                             {"Mast (dm)", "80", "80 dm"},
                                             {"MastHeight", "8", "8"},
                                             {"HEIGHT", "8", "8"}}) {
    write_text(folder / "lamps.csv",
               "lon,lat," + std::string(heading) + "\n13.4,52.5," + value + "\n");
    file.columns = {{"height", heading}};
    EXPECT_EQ(read_inventory(file).lamps.at(0).tags.at("height"), text) << heading;
  }
  // The words in brackets are no unit of this column, or part of a word.
  write_text(folder / "lamps.csv", "lon,lat,Height (new),soft\n13.4,52.5,8,4500\n");
  file.columns = {{"height", "Height (new)"}, {"lumens", "soft"}};
  EXPECT_EQ(read_inventory(file).lamps.at(0).tags,
            (osm::OsmTags{{"height", "8"}, {"light:lumens", "4500"}}));
}

TEST(Inventory, ACsvMayTellExcelItsSeparator) {
  const TempFolder folder;
  for (const char* start : {"sep=;\n", "SEP=;\r\n", "\xef\xbb\xbfsep=;\r\n"}) {
    write_text(folder / "lamps.csv", start + std::string("lat;lon;h\n52,5;13,4;8\n"));
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:4326";
    file.columns = {{"height", "h"}};
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 1u) << start;
    EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.4, 1e-9) << start;
    EXPECT_EQ(read.lamps[0].tags.at("height"), "8") << start;
  }
}

// 95 km east of the false origin at longitude 29, and 2,899,340 m south of the equator.
TEST(Inventory, GridsThatCountWestAndSouthAreReadInEitherSign) {
  const TempFolder folder;
  for (const char* place :
       {"94952.872,2899340.048", "-94952.872,-2899340.048", "2899340.048,94952.872"}) {
    write_text(folder / "lamps.csv", "x,y,h\n" + std::string(place) + ",8\n");
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:2053";
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 1u) << place;
    EXPECT_NEAR(read.lamps[0].lon_lat.x, 28.05, 1e-6) << place;
    EXPECT_NEAR(read.lamps[0].lon_lat.y, -26.2, 1e-6) << place;
  }
}

TEST(Inventory, RowsThatTheServerLeftOutAreTold) {
  const TempFolder folder;
  const auto incomplete = [&](const std::string& said, const std::string& behind = "") {
    write_text(folder / "lamps.geojson",
               "{\"type\":\"FeatureCollection\"," + said +
                   "\"features\":[{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":"
                   "\"Point\",\"coordinates\":[13.4,52.5]}}]" +
                   behind + "}");
    InventoryFile file;
    file.file = folder / "lamps.geojson";
    return read_inventory(file).report.incomplete;
  };
  EXPECT_EQ(incomplete(""), "");
  EXPECT_EQ(incomplete("\"exceededTransferLimit\":false,"), "");
  EXPECT_EQ(incomplete("\"numberMatched\":1,\"numberReturned\":1,"), "");
  EXPECT_NE(incomplete("\"exceededTransferLimit\" : true,").find("exceededTransferLimit"),
            std::string::npos);
  EXPECT_NE(
      incomplete("\"properties\":{\"exceededTransferLimit\":true},").find("a part of its rows"),
      std::string::npos);
  EXPECT_NE(incomplete("", ",\"numberMatched\":500,\"numberReturned\":1").find("1 of its 500 rows"),
            std::string::npos);
}

TEST(Inventory, CoordinatesOfAGridMayStandInGroupsOfDigits) {
  const TempFolder folder;
  for (const char* row : {"2'600'000;1'200'000", "2 600 000,0;1 200 000,0",
                          "2.600.000,0;1.200.000,0", "2600000;1'200'000"}) {
    write_text(folder / "lamps.csv", "E;N;h\n" + std::string(row) + ";8\n");
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:2056";
    file.x = "E";
    file.y = "N";
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 1u) << row;
    // The old observatory of Bern, of which the grid counts (swisstopo).
    EXPECT_NEAR(read.lamps[0].lon_lat.x, 7.43864, 1e-4) << row;
    EXPECT_NEAR(read.lamps[0].lon_lat.y, 46.95108, 1e-4) << row;
  }
}

TEST(Inventory, KrovaksGridIsReadInEitherSign) {
  const TempFolder folder;
  const auto place = [&](const std::string& text) {
    write_text(folder / "lamps.csv", "x,y,h\n" + text + ",8\n");
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:5514";
    return read_inventory(file).lamps.at(0).lon_lat;
  };
  const glm::dvec2 prague = place("-743000,-1043000");
  EXPECT_NEAR(prague.x, 14.42, 0.02);
  EXPECT_NEAR(prague.y, 50.08, 0.02);
  EXPECT_EQ(place("743000,1043000"), prague);
  EXPECT_EQ(place("1043000,743000"), prague);
}

TEST(Inventory, PointsInACollectionAreLamps) {
  const TempFolder folder;
  write_text(folder / "lamps.geojson",
             R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
      "geometry":{"type":"GeometryCollection","geometries":[
      {"type":"Point","coordinates":[13.4,52.5]},
      {"type":"LineString","coordinates":[[13.4,52.5],[13.5,52.5]]},
      {"type":"MultiPoint","coordinates":[[13.41,52.5]]}]}}]})");
  InventoryFile file;
  file.file = folder / "lamps.geojson";
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_NEAR(read.lamps[1].lon_lat.x, 13.41, 1e-9);
}

TEST(Inventory, LatitudeAndLongitudeMayStandInOneColumn) {
  const TempFolder folder;
  for (const char* text :
       {"geo_point_2d,h\n\"52.5, 13.4\",8\n", "h;Geo Point\n8;52.5,13.4\n",
        "Location,h\n\"(52.5, 13.4)\",8\n", "Latitude (deg),Longitude (deg),h\n52.5,13.4,8\n"}) {
    write_text(folder / "lamps.csv", text);
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:4326";
    file.columns = {{"height", "h"}};
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 1u) << text;
    EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.4, 1e-9) << text;
    EXPECT_NEAR(read.lamps[0].lon_lat.y, 52.5, 1e-9) << text;
    EXPECT_EQ(read.lamps[0].tags.at("height"), "8");
    EXPECT_TRUE(look_at_table(file.file).has_points) << text;
  }
}

TEST(Inventory, TruthsAreYesAndNo) {
  const TempFolder folder;
  write_text(folder / "lamps.geojson",
             R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"on":false},
"geometry":{"type":"Point","coordinates":[13.4,52.5]}}]})");
  InventoryFile file;
  file.file = folder / "lamps.geojson";
  file.columns = {{"state", "on"}};
  EXPECT_EQ(read_inventory(file).lamps.at(0).tags, (osm::OsmTags{{"operational_status", "no"}}));
}

TEST(Inventory, ALampKeepsItsIdentityWhenRowsAreAdded) {
  const TempFolder folder;
  write_text(folder / "lamps.geojson", three_lamps);
  const Inventory before = read_inventory(make_file(folder / "lamps.geojson"));
  std::string more = three_lamps;
  const std::string row =
      R"({"type":"Feature","properties":{"ID":"z"},"geometry":{"type":"Point","coordinates":[13.3,52.5]}},)";
  more.insert(more.find("{\"type\":\"Feature\""), row);
  write_text(folder / "lamps.geojson", more);
  const Inventory after = read_inventory(make_file(folder / "lamps.geojson"));
  ASSERT_EQ(after.lamps.size(), 3u);
  EXPECT_EQ(after.lamps[1].id, before.lamps[0].id);
}

TEST(Inventory, ACsvHasItsPlacesInColumnsAndItsCrsInTheRecipe) {
  const TempFolder folder;
  // Half a degree east of the middle of zone 33 at 52.5 N (GeographicLib's GeoConvert).
  write_text(folder / "lamps.csv",
             "\xEF\xBB\xBF"
             "ID;EAST;NORTH;HT\na;391000;5819000;8,5\nb;;;7\n");
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.columns = {{"height", "ht"}};
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("name them by x and y"), std::string::npos)
      << error_of([&] { read_inventory(file); });
  file.x = "EAST";
  file.y = "NORTH";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("names no CRS"), std::string::npos)
      << error_of([&] { read_inventory(file); });
  file.crs = "EPSG:25833";
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 1u);
  EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.394, 0.01);
  EXPECT_NEAR(read.lamps[0].lon_lat.y, 52.508, 0.01);
  EXPECT_EQ(read.lamps[0].tags.at("height"), "8,5");
  file.crs = "EPSG:1";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("unknown CRS"), std::string::npos);
}

TEST(Inventory, ACsvMayHoldGeometriesAsTextAndNamesInCodePages) {
  const TempFolder folder;
  const auto place_of = [&](const std::string& text) {
    write_text(folder / "lamps.csv", text);
    InventoryFile file;
    file.file = folder / "lamps.csv";
    file.crs = "EPSG:4326";
    file.columns = {{"height", "H\xC3\xB6he"}};
    const Inventory read = read_inventory(file);
    EXPECT_EQ(read.lamps.at(0).tags.at("height"), "8,5") << text;
    return read.lamps.at(0).lon_lat;
  };
  for (const char* text : {"id;the_geom;H\xC3\xB6he\n1;POINT (13.4 52.5);8,5\n",
                           "id;geo_shape;H\xC3\xB6he\n1;\"{\"\"type\"\":\"\"Point\"\","
                           "\"\"coordinates\"\":[13.4,52.5]}\""
                           ";8,5\n",
                           "id;L\xC3\xA4ngengrad;Breitengrad;H\xC3\xB6he\n1;13,4;52,5;8,5\n",
                           "id;Laengengrad;Breitengrad;H\xF6he\n1;13,4;52,5;8,5\n"}) {
    const glm::dvec2 place = place_of(text);
    EXPECT_NEAR(place.x, 13.4, 1e-6) << text;
    EXPECT_NEAR(place.y, 52.5, 1e-6) << text;
  }
}

// Writes the same lamp in EPSG:25833 by a driver of GDAL.
void write_lamp(const std::filesystem::path& path, const char* driver, bool with_crs = true) {
  gdal::register_drivers();
  GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName(driver)->Create(
      path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  ASSERT_TRUE(set);
  OGRSpatialReference crs;
  crs.importFromEPSG(25833);
  OGRLayer* layer = set->CreateLayer("lamps", with_crs ? &crs : nullptr, wkbPoint, nullptr);
  OGRFieldDefn height("HT", OFTReal);
  layer->CreateField(&height);
  OGRFeatureUniquePtr row(OGRFeature::CreateFeature(layer->GetLayerDefn()));
  row->SetField("HT", 8.5);
  OGRPoint point(391000, 5819000);
  row->SetGeometry(&point);
  ASSERT_EQ(layer->CreateFeature(row.get()), OGRERR_NONE);
}

TEST(Inventory, EveryFormatGivesTheSameLamp) {
  const TempFolder folder;
  glm::dvec2 first(0);
  for (const auto& [name, driver] :
       {std::pair("lamps.gpkg", "GPKG"), std::pair("lamps.shp", "ESRI Shapefile"),
        std::pair("lamps.fgb", "FlatGeobuf")}) {
    write_lamp(folder / name, driver);
    InventoryFile file;
    file.file = folder / name;
    file.columns = {{"height", "HT"}};
    const Inventory read = read_inventory(file);
    ASSERT_EQ(read.lamps.size(), 1u) << name;
    EXPECT_EQ(read.report.format, driver);
    EXPECT_EQ(read.lamps[0].tags.at("height"), "8.5") << name;
    if (first.x == 0) first = read.lamps[0].lon_lat;
    EXPECT_NEAR(read.lamps[0].lon_lat.x, first.x, 1e-9) << name;
    EXPECT_NEAR(read.lamps[0].lon_lat.y, first.y, 1e-9) << name;
  }
  EXPECT_NEAR(first.x, 13.394, 0.01);
  std::filesystem::remove(folder / "lamps.prj");
  InventoryFile file;
  file.file = folder / "lamps.shp";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("names no CRS"), std::string::npos);
}

// As PROJ would open whatever grid it names, a device say.
TEST(Inventory, ACrsThatNamesAFileIsAnErrorOfItsTable) {
  const TempFolder folder;
  write_lamp(folder / "lamps.shp", "ESRI Shapefile");
  write_text(folder / "other", "no grid");
  write_text(folder / "lamps.prj",
             "PROJCS[\"a\",GEOGCS[\"b\",DATUM[\"c\",SPHEROID[\"GRS80\",6378137,298.257],"
             "EXTENSION[\"PROJ4_GRIDS\",\"" +
                 (folder / "other").string() +
                 "\"]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
                 "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
                 "PARAMETER[\"central_meridian\",15],PARAMETER[\"scale_factor\",0.9996],"
                 "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],"
                 "UNIT[\"metre\",1]]");
  InventoryFile file;
  file.file = folder / "lamps.shp";
  const std::string message = error_of([&] { read_inventory(file); });
  EXPECT_NE(message.find("lamps.shp: CRS"), std::string::npos) << message;
  EXPECT_NE(message.find("names the file"), std::string::npos) << message;
}

TEST(Inventory, RowsAtOnePlaceAreLuminairesOfOnePost) {
  const TempFolder folder;
  write_text(folder / "l.csv",
             "lon,lat,LM\n13.4,52.5,4000\n13.4,52.5,2000\n13.4,52.5,3000\n13.5,52.5,1000\n");
  InventoryFile file;
  file.file = folder / "l.csv";
  file.crs = "EPSG:4326";
  file.columns = {{"lumens", "LM"}};
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.report.joined, 2u);
  osm::OsmData map;
  map.lamps = read.lamps;
  const auto plane = [](const glm::dvec2&) { return std::optional(0.0); };
  const lights::LampSet set = lights::place_lamps(
      map, [](const glm::dvec2& p) { return p * 1e5; }, plane);
  ASSERT_EQ(set.lamps.size(), 4u);
  double flux = 0;
  for (const lights::PlacedLamp& lamp : set.lamps) {
    EXPECT_EQ(lamp.provenance.flux, ValueSource::inventory);
    EXPECT_EQ(lamp.provenance.position, ValueSource::inventory);
    EXPECT_EQ(lamp.provenance.height, ValueSource::rule);
    flux += lamp.flux_lm;
  }
  EXPECT_NEAR(flux, 10000, 0.1) << "no light is lost or made";
}

TEST(Inventory, StandsInPlaceOfTheMapsLampsNearby) {
  const TempFolder folder;
  write_text(folder / "l.csv", "lon,lat,STATE\n13.4,52.5,on\n13.41,52.5,Removed\n");
  InventoryFile file;
  file.file = folder / "l.csv";
  file.crs = "EPSG:4326";
  file.columns = {{"state", "STATE"}};
  file.values["state"]["Removed"] = "no";
  file.within_m = 5;
  constexpr double metre = 1 / 111'195.0;  // of latitude
  osm::OsmData map;
  map.lamps = {{1, {13.4, 52.5 + 4.9 * metre}, {}},
               {2, {13.4, 52.5 + 5.1 * metre}, {}},
               {3, {13.4 + 4.9 * metre / 0.6088, 52.5}, {}},
               {4, {13.4 + 5.1 * metre / 0.6088, 52.5}, {}},
               {5, {13.41, 52.5}, {}}};
  const auto reports = add_to_map({file}, map);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].replaced, 3u);
  ASSERT_EQ(map.lamps.size(), 4u);
  EXPECT_EQ(map.lamps[2].id, 2);
  EXPECT_EQ(map.lamps[3].id, 4);
  const auto plane = [](const glm::dvec2&) { return std::optional(0.0); };
  const lights::LampSet set = lights::place_lamps(
      map, [](const glm::dvec2& p) { return p * 1e5; }, plane);
  EXPECT_EQ(set.lamps.size(), 3u) << "the town knows that one is gone, whatever the map says";
  EXPECT_EQ(set.left_out.at("broken"), 1u);
}

TEST(Inventory, LampsOfTheMapAreReplacedAcrossTheAntimeridianToo) {
  const TempFolder folder;
  write_text(folder / "lamps.csv", "lon,lat\n179.99999,0\n-179.99,0\n");
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  file.within_m = 5;
  osm::OsmData map;
  map.lamps = {{1, {-179.99998, 0}, {}}, {2, {-179.99999, 0.001}, {}}};  // 3.3 m, and 111 m away
  const auto reports = add_to_map({file}, map);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].replaced, 1u);
  ASSERT_EQ(map.lamps.size(), 3u);
  EXPECT_EQ(map.lamps[2].id, 2);
}

// As spreadsheets save "Unicode text".
TEST(Inventory, TablesInUtf16AreRead) {
  const TempFolder folder;
  const std::u16string text = u"lon\tlat\tlamp_type\n13.4\t52.5\tled \u00e9\U0001F4A1\n";
  for (const bool big : {false, true}) {
    std::string bytes = big ? "\xfe\xff" : "\xff\xfe";
    for (const char16_t c : text) {
      const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
      bytes += big ? high : low;
      bytes += big ? low : high;
    }
    write_text(folder / "lamps.tsv", bytes);
    InventoryFile file;
    file.file = folder / "lamps.tsv";
    file.crs = "EPSG:4326";
    file.columns = {{"type", "lamp_type"}};
    for (int again = 0; again < 2; ++again) {
      const Inventory read = read_inventory(file);
      ASSERT_EQ(read.lamps.size(), 1u);
      EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5));
      EXPECT_EQ(read.lamps[0].tags.at("lamp_type"), "led \u00e9\U0001F4A1");
    }
    EXPECT_TRUE(look_at_table(file.file).has_points);
  }
}

TEST(Inventory, DegreesMinutesAndSecondsAreRead) {
  const TempFolder folder;
  write_text(
      folder / "lamps.csv",
      "lon;lat\n\"13\u00b024'18\"\"E\";\"52\u00b031'12.5\"\"N\"\n13 24.3 W;-52:31:12,5\n13.4;52.5\n"
      "13\u00b024'18\"O;52\u00b031'N\n");
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 3u);
  const double lon = 13 + 24 / 60.0 + 18 / 3600.0, lat = 52 + 31 / 60.0 + 12.5 / 3600;
  EXPECT_NEAR(read.lamps[0].lon_lat.x, lon, 1e-12);
  EXPECT_NEAR(read.lamps[0].lon_lat.y, lat, 1e-12);
  EXPECT_NEAR(read.lamps[1].lon_lat.x, -lon, 1e-12);
  EXPECT_NEAR(read.lamps[1].lon_lat.y, -lat, 1e-12);
  EXPECT_EQ(read.report.skipped.at("without a place"), 1u) << "an O is east or west";
  EXPECT_TRUE(look_at_table(file.file).has_points);
  file.crs = "EPSG:25833";
  const auto error = error_of([&] { read_inventory(file); });
  EXPECT_NE(error.find("degrees"), std::string::npos) << error;
  // Both in one column, in either order.
  for (const char* text :
       {"52\u00b031'12.5\"N 13\u00b024'18\"E", "E13\u00b024'18\" N52\u00b031'12.5\"",
        "52\u00b031'12,5\"N, 13\u00b024'18,0\"E", "52 31 12.5, 13 24 18"}) {
    std::string quoted;
    for (const char c : std::string_view(text)) quoted += c == '"' ? "\"\"" : std::string(1, c);
    write_text(folder / "one.csv", "id,location\n1,\"" + quoted + "\"\n");
    file = {};
    file.file = folder / "one.csv";
    file.crs = "EPSG:4326";
    const Inventory one = read_inventory(file);
    ASSERT_EQ(one.lamps.size(), 1u) << text;
    EXPECT_NEAR(one.lamps[0].lon_lat.x, lon, 1e-12) << text;
    EXPECT_NEAR(one.lamps[0].lon_lat.y, lat, 1e-12) << text;
  }
}

// Found by fuzzing: 180 to 360 degrees stayed what they were.
TEST(Inventory, LongitudesCountedFrom0To360AreThoseOfAMap) {
  const TempFolder folder;
  InventoryFile file;
  file.file = folder / "lamps.csv";
  file.crs = "EPSG:4326";
  write_text(file.file, "lon,lat\n182.25,52.5\n360,52.5\n-190.5,52.5\n180,52.5\n");
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 4u);
  const double expected[] = {-177.75, 0, 169.5, 180};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(read.lamps[i].lon_lat.x, expected[i]) << "row " << i;
}

TEST(Inventory, GeometriesOfPostgisNameTheirCrs) {
  const TempFolder folder;
  InventoryFile file;
  file.file = folder / "lamps.csv";
  write_text(
      file.file,
      "id,geom\n1,\n2,SRID=25833;POINT(391000 5819000)\n3,srid=25833; POINT Z(391010 5819000 "
      "35)\n4,SRID=25833;LINESTRING(0 0,1 1)\n5,SRID=25833;nonsense\n");
  const Inventory read = read_inventory(file);
  ASSERT_EQ(read.lamps.size(), 2u);
  // Krueger's series for UTM.
  EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.3938713, 1e-6);
  EXPECT_NEAR(read.lamps[0].lon_lat.y, 52.5102096, 1e-6);
  EXPECT_NEAR((read.lamps[1].lon_lat.x - read.lamps[0].lon_lat.x) * 111320 *
                  std::cos(52.51 * 0.017453292519943295),
              10, 0.05);
  EXPECT_EQ(look_at_table(file.file).crs, "EPSG:25833");
  EXPECT_TRUE(look_at_table(file.file).has_points);
  write_text(file.file,
             "id,geom\n1,SRID=4326;POINT(13.4 52.5)\n2,SRID=25833;POINT(391000 5819000)\n");
  const auto error = error_of([&] { read_inventory(file); });
  EXPECT_NE(error.find("several CRSs (EPSG:4326, and EPSG:25833 in row 2)"), std::string::npos)
      << error;
  // Hexadecimal EWKB, as PostGIS prints its columns.
  write_text(file.file, "id,geom\n1,0101000020E6100000CDCCCCCCCCCC2A400000000000404A40\n");
  const Inventory hex = read_inventory(file);
  ASSERT_EQ(hex.lamps.size(), 1u);
  EXPECT_NEAR(hex.lamps[0].lon_lat.x, 13.4, 1e-12);
}

TEST(Inventory, WhatCannotBeReadIsAnErrorWithARemedy) {
  const TempFolder folder;
  const auto error = [&](const std::string& name, const std::string& text) {
    write_text(folder / name, text);
    InventoryFile file;
    file.file = folder / name;
    file.columns = {{"height", "NOPE"}};
    return error_of([&] { read_inventory(file); });
  };
  EXPECT_NE(error("a.geojson", three_lamps).find("has no column \"NOPE\": it has \"ID\", \"HT\""),
            std::string::npos)
      << error("a.geojson", three_lamps);
  EXPECT_NE(error("b.zip", "PK\x03\x04").find("broken zip archive"), std::string::npos);
  EXPECT_NE(error("e.geojson", "").find("it is empty"), std::string::npos);
  EXPECT_NE(error("e.geojson", "<!DOCTYPE html><html/>").find("it is a web page"),
            std::string::npos);
  EXPECT_NE(error("e.kml", "<kml xmlns=\"k\"><Document/></kml>").find("it is KML; a table can be"),
            std::string::npos);
  EXPECT_NE(error("e.json", "{\"error\":{\"code\":400}}").find("reports an error"),
            std::string::npos);
  EXPECT_NE(error("e.json", "{\"type\":\"Topology\",\"arcs\":[]}").find("it is TopoJSON"),
            std::string::npos);
  EXPECT_NE(error("e.osm", "<osm version=\"0.6\"/>").find("belongs in [osm] files"),
            std::string::npos);
  EXPECT_NE(error("c.vrt",
                  "<OGRVRTDataSource><OGRVRTLayer name=\"x\"><SrcDataSource>/etc/passwd"
                  "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>")
                .find("is no table of lamps"),
            std::string::npos)
      << "formats that lead to other files are not opened";
  EXPECT_NE(error("d.geojson", "{\"type\":\"FeatureCollection\",\"features\":[").find("d.geojson"),
            std::string::npos);
  InventoryFile file;
  file.file = folder / "none.geojson";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("is not there"), std::string::npos);
  file.file = folder / "a.geojson";
  file.max_lamps = 3;
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("max_lamps"), std::string::npos);
  file.max_lamps = 4;
  file.crs = "EPSG:25833";
  EXPECT_EQ(error_of([&] { read_inventory(file); }).find("no error"), 0u)
      << "degrees are metres near (0, 0) there";
  write_text(folder / "points.geojson",
             R"({"type":"Feature","properties":{},"geometry":{"type":"MultiPoint",
      "coordinates":[[13.1,52],[13.2,52],[13.3,52],[13.4,52]]}})");
  file = {};
  file.file = folder / "points.geojson";
  file.max_lamps = 3;
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("more lamps than max_lamps"),
            std::string::npos)
      << "one row";
  file.max_lamps = 4;
  EXPECT_EQ(read_inventory(file).lamps.size(), 4u);
  write_text(folder / "wide.csv", std::string("\xff\xfe"
                                              "a\0,\0b\0",
                                              8));
  file = {};
  file.file = folder / "wide.csv";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("its columns are \"a\", \"b\""),
            std::string::npos)
      << error_of([&] { read_inventory(file); });
  write_text(folder / "areas.geojson",
             R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
      "geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}}]})");
  file.file = folder / "areas.geojson";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("whose geometry is no point"),
            std::string::npos);
  // Metres where the format promises degrees, as some servers write them.
  write_text(folder / "m.geojson",
             R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
      "geometry":{"type":"Point","coordinates":[391000,5819000]}}]})");
  file = {};
  file.file = folder / "m.geojson";
  EXPECT_NE(error_of([&] { read_inventory(file); }).find("say the CRS by crs"), std::string::npos);
}

TEST(Inventory, ARealOneIsReadWhole) {
  REAL_DATA(file, "lamps/kansas_city_poles.geojson");
  InventoryFile inventory;
  inventory.file = file;
  inventory.id = "POLEID";
  const Inventory read = read_inventory(inventory);
  EXPECT_EQ(read.report.rows, read.lamps.size() + read.report.joined);
  EXPECT_GT(read.lamps.size(), 50u);
  for (const osm::OsmLampNode& lamp : read.lamps) {
    EXPECT_NEAR(lamp.lon_lat.x, -94.5, 0.5);
    EXPECT_NEAR(lamp.lon_lat.y, 39.1, 0.5);
  }
}

}  // namespace
}  // namespace nightcity::inventory
