// Tables of lamps in archives and gzip streams.
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <zlib.h>

#include <map>
#include <string>
#include <utility>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/pack_archive.h"
#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/look_at_table.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::inventory {
namespace {

using test::read_text;
using test::TempFolder;
using test::write_text;

using Entries = std::map<std::string, std::string>;

void pack_zip(const std::filesystem::path& path, const Entries& entries) {
  test::pack_zip(path, {entries.begin(), entries.end()});
}

void pack_gzip(const std::filesystem::path& path, const std::string& bytes) {
  const gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
            static_cast<int>(bytes.size()));
  gzclose(file);
}

// Returns the files of a Shapefile of one lamp at 13.4 E, 52.5 N, by their names in a folder.
Entries make_shapefile(const std::string& stem, const char* ending_of_prj = ".prj") {
  const TempFolder folder;
  gdal::register_drivers();
  {
    GDALDatasetUniquePtr data(
        GetGDALDriverManager()
            ->GetDriverByName("ESRI Shapefile")
            ->Create((folder / "a.shp").c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRSpatialReference crs;
    crs.importFromEPSG(4326);
    OGRLayer* layer = data->CreateLayer("a", &crs, wkbPoint, nullptr);
    OGRFieldDefn id("LAMP_ID", OFTString);
    EXPECT_EQ(layer->CreateField(&id), OGRERR_NONE);
    OGRFeature row(layer->GetLayerDefn());
    row.SetField("LAMP_ID", "x");
    OGRPoint point(13.4, 52.5);
    row.SetGeometry(&point);
    EXPECT_EQ(layer->CreateFeature(&row), OGRERR_NONE);
  }
  Entries files;
  for (const std::string ending : {".shp", ".shx", ".dbf"})
    files[stem + ending] = read_text(folder / ("a" + ending));
  files[stem + ending_of_prj] = read_text(folder / "a.prj");
  return files;
}

constexpr const char* one_lamp =
    R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
    R"("geometry":{"type":"Point","coordinates":[13.4,52.5]}}]})";
constexpr const char* one_line = "id;lon;lat\na;13.4;52.5\n";

Inventory read_packed(const std::filesystem::path& path, const std::string& crs = "") {
  InventoryFile file;
  file.file = path;
  file.crs = crs;
  return read_inventory(file);
}

void expect_lamp(const std::filesystem::path& path, const std::string& crs = "") {
  try {
    const Inventory read = read_packed(path, crs);
    ASSERT_EQ(read.lamps.size(), 1u) << path;
    EXPECT_EQ(read.lamps[0].lon_lat, glm::dvec2(13.4, 52.5)) << path;
  } catch (const Error& error) {
    ADD_FAILURE() << error.what();
  }
}

std::string why_not_packed(const std::filesystem::path& path) {
  return test::message_of([&] { read_packed(path, "EPSG:4326"); }, "was read");
}

TEST(PackedTable, AShapefileLiesInAnArchive) {
  const TempFolder folder;
  // Names lead nowhere: files of an archive are in memory, by the last part of their names.
  for (const char* stem : {"lamps", "data/x/lamps", "../../../../tmp/lamps", "/lamps"}) {
    pack_zip(folder / "a.zip", make_shapefile(stem));
    expect_lamp(folder / "a.zip");
  }
  Entries others = make_shapefile("LAMPS", ".PRJ");
  others.insert({{"readme.txt", "x"}, {"LAMPS.shp.xml", "<a/>"}, {"__MACOSX/._LAMPS.shp", "x"}});
  pack_zip(folder / "a.shz", others);
  expect_lamp(folder / "a.shz");
  const TableLook look = look_at_table(folder / "a.shz");
  EXPECT_EQ(look.layer, "LAMPS");
  EXPECT_EQ(look.format, "ESRI Shapefile");
  EXPECT_NE(look.crs, "");
}

TEST(PackedTable, OneTableOfAnyFormatLiesInAnArchive) {
  const TempFolder folder;
  pack_zip(folder / "a.zip", {{"lamps.geojson", one_lamp}, {"readme.md", "x"}});
  expect_lamp(folder / "a.zip");
  pack_zip(folder / "a.zip", {{"a/lamps.csv", one_line}});
  expect_lamp(folder / "a.zip", "EPSG:4326");
  pack_zip(folder / "a.zip", {{"lamps.json", R"([{"lat":52.5,"lon":13.4}])"}});
  expect_lamp(folder / "a.zip", "EPSG:4326");
  pack_zip(folder / "a.zip", {{"lamps.csv", "sep=|\nid|lon|lat\na|13.4|52.5\n"}});
  expect_lamp(folder / "a.zip", "EPSG:4326");
}

TEST(PackedTable, AGzipStreamHoldsATable) {
  const TempFolder folder;
  pack_gzip(folder / "lamps.csv.gz", one_line);
  expect_lamp(folder / "lamps.csv.gz", "EPSG:4326");
  for (const char* name : {"lamps.geojson.gz", "lamps.gz", "lamps.geojson"}) {
    pack_gzip(folder / name, one_lamp);
    expect_lamp(folder / name);
  }
  const std::string page = R"({"numberMatched":9,"numberReturned":1,)";
  pack_gzip(folder / "page.geojson.gz", page + std::string(one_lamp).substr(1));
  EXPECT_NE(read_packed(folder / "page.geojson.gz").report.incomplete.find("1 of its 9"),
            std::string::npos);
}

TEST(PackedTable, EveryFormHoldsTheSameLamp) {
  const TempFolder folder;
  const Entries shapefile = make_shapefile("data/lamps");
  for (const char* form : test::archive_forms) {
    const auto path = folder / ("a" + std::string(form));
    test::pack_archive(path, {shapefile.begin(), shapefile.end()});
    expect_lamp(path);
    test::pack_archive(path, {{"readme.md", "x"}, {"lamps.csv", one_line}});
    expect_lamp(path, "EPSG:4326");
  }
  for (const char* form : test::stream_forms) {
    const auto path = folder / ("lamps.csv" + std::string(form));
    test::pack_stream(path, one_line);
    expect_lamp(path, "EPSG:4326");
    test::pack_archive(folder / "b.tar",
                       {{"lamps.csv" + std::string(form), test::read_text(path)}});
    expect_lamp(folder / "b.tar", "EPSG:4326");
  }
}

TEST(PackedTable, WhatIsNotOneTableIsNamedWithARemedy) {
  const TempFolder folder;
  pack_zip(folder / "a.zip", {{"lamps.csv", one_line}, {"x/poles.geojson", one_lamp}});
  EXPECT_NE(why_not_packed(folder / "a.zip")
                .find("several tables (lamps.csv, x/poles.geojson): unpack it"),
            std::string::npos);
  pack_zip(folder / "a.zip", {{"readme.txt", "x"}});
  EXPECT_NE(why_not_packed(folder / "a.zip").find("but readme.txt: unpack it"), std::string::npos);
  pack_zip(folder / "a.zip", {{"b.zip", "x"}});
  EXPECT_NE(why_not_packed(folder / "a.zip").find("another packed file (b.zip)"),
            std::string::npos);
  pack_zip(folder / "a.zip", {{"lamps.dbf", "x"}});
  EXPECT_NE(why_not_packed(folder / "a.zip").find("no table of lamps"), std::string::npos);
  for (const auto& [name, remedy] :
       {std::pair{"a.xlsx", "save its table as CSV"}, std::pair{"a.ods", "save its table as CSV"},
        std::pair{"a.kmz", "is KML in an archive"}}) {
    pack_zip(folder / name, {{"[Content_Types].xml", "<Types/>"}});
    EXPECT_NE(why_not_packed(folder / name).find(remedy), std::string::npos) << name;
  }
  pack_gzip(folder / "lamps.csv.gz", one_line);
  pack_gzip(folder / "lamps.csv.gz", read_text(folder / "lamps.csv.gz"));
  EXPECT_NE(why_not_packed(folder / "lamps.csv.gz").find("by gzip twice"), std::string::npos);
  Entries cut = make_shapefile("lamps");
  cut.erase("lamps.shx");
  pack_zip(folder / "a.zip", cut);
  EXPECT_NE(why_not_packed(folder / "a.zip").find("lamps.shx that belongs"), std::string::npos);
  pack_gzip(folder / "lamps.csv.gz", std::string(100'000, 'x'));
  write_text(folder / "lamps.csv.gz", read_text(folder / "lamps.csv.gz").substr(0, 60));
  EXPECT_NE(why_not_packed(folder / "lamps.csv.gz").find("broken gzip"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::inventory
