// Forms of tables that portals and programs write, with the places and values that they mean.
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <string>
#include <utility>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/temp_folder.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/look_at_table.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {
namespace {

using test::TempFolder;
using test::write_text;

Inventory read_form(const TempFolder& folder, const std::string& name, const std::string& text,
                    const std::string& crs = "EPSG:4326") {
  write_text(folder / name, text);
  InventoryFile file;
  file.file = folder / name;
  file.crs = crs;
  return read_inventory(file);
}

// Expects 13.4 E, 52.5 N where a CSV's columns of these names have these values.
void expect_place(const TempFolder& folder, const std::string& names, const std::string& values) {
  const Inventory read = read_form(folder, "lamps.csv", "ID," + names + "\na," + values + "\n");
  ASSERT_EQ(read.lamps.size(), 1u) << names;
  EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << names;
}

std::string why_not(const TempFolder& folder, const std::string& name, const std::string& text,
                    const std::string& crs = "EPSG:4326") {
  return test::message_of([&] { read_form(folder, name, text, crs); }, "was read");
}

constexpr const char* one_feature =
    R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[13.4,52.5]}})";

TEST(TableForms, WordsThatSayMoreMayStandBesideACoordinatesName) {
  const TempFolder folder;
  for (const char* names : {"GPS_LON,GPS_LAT",
                            "gps_x,gps_y",
                            "Lon_dd,Lat_dd",
                            "lon_deg,lat_deg",
                            "Long_,Lat_",
                            "E,N",
                            "coord x,coord y",
                            "Koord_X,Koord_Y",
                            "x-koordinate,y-koordinate",
                            "Rechts,Hoch",
                            "MapX,MapY",
                            "centroid_x,centroid_y",
                            "longitude_wgs84,latitude_wgs84",
                            "decimalLongitude,decimalLatitude",
                            "xcoordinate,ycoordinate",
                            "LONGDD,LATDD",
                            "COORDENADA_X,COORDENADA_Y",
                            "geometry.x,geometry.y",
                            "UTM Easting,UTM Northing",
                            "x_25833,y_25833",
                            "X (m),Y (m)",
                            "経度,緯度",
                            "经度,纬度",
                            "Долгота,Широта",
                            "coords.long,coords.lat",
                            "geom_x_y.lon,geom_x_y.lat",
                            "Længdegrad,Breddegrad"}) {
    expect_place(folder, names, "13.4,52.5");
  }
}

TEST(TableForms, LengthsAndLabelsAreNoCoordinates) {
  const TempFolder folder;
  for (const char* names : {"Lengte,Breedte", "label_x,label_y", "lon,latency", "gps_x,map_y"})
    EXPECT_NE(why_not(folder, "lamps.csv", "ID," + std::string(names) + "\na,13.4,52.5\n")
                  .find("no columns with coordinates"),
              std::string::npos)
        << names;
}

// Names that words fit in many ways, of nearly as many columns as GDAL reads (2,000).
TEST(TableForms, ManyColumnsAreLookedAtInNoTimeAndNotAllNamed) {
  const TempFolder folder;
  std::string names = "ID", values = "a";
  for (int i = 0; i < 1500; ++i) {
    names += ",geomgeomgeomgeomgeomgeomgeomgeomgeomgeomgeomgeomgeomqe" + std::to_string(i % 10);
    values += ",1";
  }
  const std::string why = why_not(folder, "lamps.csv", names + "\n" + values + "\n");
  EXPECT_NE(why.find("and 1451 more"), std::string::npos) << why.substr(0, 200);
  EXPECT_LT(why.size(), 10'000u);
}

TEST(TableForms, APairAloneComesBeforeOneWithMoreWords) {
  const TempFolder folder;
  const Inventory read = read_form(folder, "lamps.csv", "gps_lon,gps_lat,x,y\n1,2,13.4,52.5\n");
  EXPECT_EQ(read.lamps.at(0).lon_lat, glm::dvec2(13.4, 52.5));
}

TEST(TableForms, GeometriesInTextAreFoundWhateverTheirColumnIsCalled) {
  const TempFolder folder;
  for (const char* name : {"Location", "shape_wkt", "Standort"}) {
    expect_place(folder, name, "POINT (13.4 52.5)");
  }
}

TEST(TableForms, AnAddressMayStandBeforeAPlaceInBrackets) {
  const TempFolder folder;
  const Inventory read =
      read_form(folder, "lamps.csv", "ID,Location\na,\"1 Main St (rear)\nBerlin\n(52.5, 13.4)\"\n");
  ASSERT_EQ(read.lamps.size(), 1u);
  EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5));
}

TEST(TableForms, DegreesMinutesAndSecondsMayStandApartByBlanks) {
  const TempFolder folder;
  const Inventory read =
      read_form(folder, "lamps.csv", "lon,lat\n13 24 00,52 30 00\n13 25 12.0,52 30 36\n");
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_NEAR(read.lamps[0].lon_lat.x, 13.4, 1e-12);
  EXPECT_NEAR(read.lamps[1].lon_lat.x, 13.42, 1e-12);
  EXPECT_NEAR(read.lamps[1].lon_lat.y, 52.51, 1e-12);
}

TEST(TableForms, BlankLinesMayStandBeforeTheHeadings) {
  const TempFolder folder;
  for (const char* start : {"\n", "\r\n\r\n", "  \n\t\n", "\xef\xbb\xbf\n"})
    EXPECT_EQ(
        read_form(folder, "lamps.csv", std::string(start) + "lon,lat\n13.4,52.5\n").lamps.size(),
        1u);
}

// A mark of UTF-8 made GDAL read the first object alone.
TEST(TableForms, AnObjectALineMayBeginWithAMark) {
  const TempFolder folder;
  std::string second = one_feature;
  second.replace(second.find("13.4"), 4, "13.5");
  for (const std::string start : {"\xef\xbb\xbf", "\xef\xbb\xbf\x1e", ""})
    EXPECT_EQ(read_form(folder, "lamps.geojsonl",
                        start + one_feature + "\n" + (start.ends_with('\x1e') ? "\x1e" : "") +
                            second + "\n",
                        "")
                  .lamps.size(),
              2u);
}

TEST(TableForms, APageOfRowsWithALinkToTheNextIsTold) {
  const TempFolder folder;
  const auto incomplete = [&](const std::string& rel) {
    return read_form(
               folder, "a.geojson",
               R"({"type":"FeatureCollection","links":[{"href":"x","rel":"self"},{"rel" : ")" +
                   rel + R"("}],"features":[)" + one_feature + "]}",
               "")
        .report.incomplete;
  };
  EXPECT_NE(incomplete("next").find("one page"), std::string::npos);
  EXPECT_EQ(incomplete("prev"), "");
}

// One such row moved the table's middle out of the area of use, and all rows to the other half of
// the Earth.
TEST(TableForms, RowsAtZeroDoNotTurnTheOthers) {
  const TempFolder folder;
  const Inventory read =
      read_form(folder, "lamps.csv",
                "x,y\n94952.872,2899340.048\n0,0\n94952.872,2899350.048\n0,0\n94962.872,2899350\n",
                "EPSG:2053");
  ASSERT_EQ(read.lamps.size(), 3u);
  EXPECT_EQ(read.report.skipped.at("at 0, 0, as programs write that know no place"), 2u);
  EXPECT_NEAR(read.lamps[0].lon_lat.x, 28.05, 1e-6);
  EXPECT_NEAR(read.lamps[0].lon_lat.y, -26.2, 1e-6);
}

// Text of WKT 1 says no area of use; its code does.
TEST(TableForms, ADefinitionInWktCountsAsItsCodeDoes) {
  const TempFolder folder;
  gdal::register_drivers();
  OGRSpatialReference crs;
  crs.importFromEPSG(2053);
  char* text = nullptr;
  crs.exportToWkt(&text);
  const std::string wkt = text;
  CPLFree(text);
  for (const char* place : {"94952.872,2899340.048", "-94952.872,-2899340.048"}) {
    const Inventory read = read_form(folder, "lamps.csv", "x,y\n" + std::string(place) + "\n", wkt);
    EXPECT_NEAR(read.lamps.at(0).lon_lat.x, 28.05, 1e-6) << place;
    EXPECT_NEAR(read.lamps.at(0).lon_lat.y, -26.2, 1e-6) << place;
  }
}

TEST(TableForms, ADatumWithoutAKnownShiftIsTold) {
  const TempFolder folder;
  // Locodjo 1965 / UTM zone 30N, on its central meridian in Ivory Coast.
  const Inventory old = read_form(folder, "lamps.csv", "x,y\n500000,800000\n", "EPSG:2040");
  EXPECT_NE(old.report.doubt.find("no shift from WGS 84"), std::string::npos) << old.report.doubt;
  EXPECT_EQ(read_form(folder, "lamps.csv", "x,y\n500000,5800000\n", "EPSG:25833").report.doubt, "");
}

struct Layer {
  const char* name;
  OGRwkbGeometryType type;
  int epsg;  // 0: the GeoPackage's own undefined system of degrees
};

void write_package(const std::filesystem::path& path, std::initializer_list<Layer> layers) {
  gdal::register_drivers();
  GDALDatasetUniquePtr data(GetGDALDriverManager()->GetDriverByName("GPKG")->Create(
      path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  for (const Layer& one : layers) {
    OGRSpatialReference crs;
    if (one.epsg != 0) crs.importFromEPSG(one.epsg);
    const bool has_crs = one.type != wkbNone && one.epsg != 0;
    OGRLayer* layer = data->CreateLayer(one.name, has_crs ? &crs : nullptr, one.type, nullptr);
    OGRFieldDefn id("ID", OFTString);
    ASSERT_EQ(layer->CreateField(&id), OGRERR_NONE);
    OGRFeature row(layer->GetLayerDefn());
    row.SetField("ID", one.name);
    OGRPoint point(13.4, 52.5);
    if (one.type != wkbNone) row.SetGeometry(&point);
    ASSERT_EQ(layer->CreateFeature(&row), OGRERR_NONE);
  }
}

Inventory read_package(const TempFolder& folder) {
  InventoryFile file;
  file.file = folder / "lamps.gpkg";
  return read_inventory(file);
}

TEST(TableForms, TheOneLayerWithPointsIsTakenAmongTablesOfOtherThings) {
  const TempFolder folder;
  write_package(folder / "lamps.gpkg", {{"layer_styles", wkbNone, 0}, {"lamps", wkbPoint, 4326}});
  EXPECT_EQ(read_package(folder).lamps.size(), 1u);
}

TEST(TableForms, SeveralLayersWithPointsAskForAName) {
  const TempFolder folder;
  write_package(folder / "lamps.gpkg", {{"trees", wkbPoint, 4326}, {"lamps", wkbPoint, 4326}});
  EXPECT_THROW(read_package(folder), Error);
}

TEST(TableForms, AnUndefinedSystemIsNone) {
  const TempFolder folder;
  write_package(folder / "lamps.gpkg", {{"lamps", wkbPoint, 0}});
  try {
    read_package(folder);
    FAIL() << "was placed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("names no CRS"), std::string::npos) << error.what();
  }
}

// A Shapefile's names have ten letters.
TEST(TableForms, NamesThatAShapefileCutAreGuessed) {
  const TempFolder folder;
  gdal::register_drivers();
  {
    GDALDatasetUniquePtr data(
        GetGDALDriverManager()
            ->GetDriverByName("ESRI Shapefile")
            ->Create((folder / "lamps.shp").c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRLayer* layer = data->CreateLayer("lamps", nullptr, wkbPoint, nullptr);
    for (const char* name : {"mounting_h", "lamp_watta"}) {
      OGRFieldDefn field(name, OFTReal);
      ASSERT_EQ(layer->CreateField(&field), OGRERR_NONE);
    }
  }
  const InventoryFile guess =
      guess_inventory(folder / "lamps.shp", look_at_table(folder / "lamps.shp"));
  EXPECT_EQ(guess.columns.at("height"), "mounting_h");
  EXPECT_EQ(guess.columns.at("watts"), "lamp_watta");
}

}  // namespace
}  // namespace nightcity::inventory
