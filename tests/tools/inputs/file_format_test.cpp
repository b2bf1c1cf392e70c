#include "tools/inputs/file_format.h"

#include <gtest/gtest.h>
#include <zip.h>
#include <zlib.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "support/pack_archive.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/city/foreign_format.h"
#include "tools/inputs/read_city.h"

namespace nightcity::inputs {
namespace {

using test::TemporaryFile;

const std::string city_text = test::city_model(test::member(test::building("A")));
const std::string osm_text = "<?xml version=\"1.0\"?>\n<osm version=\"0.6\"></osm>";

std::string name_of_format(const std::string& content, const std::string& ending) {
  return find_format(TemporaryFile(content, ending).path()).name;
}

std::string gzipped(const std::string& text) {
  const TemporaryFile file("", ".gz");
  const gzFile out = gzopen(file.path().c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FileFormat, ContentDecidesAndNotTheName) {
  EXPECT_EQ(name_of_format(city_text, ".txt"), "CityGML");
  EXPECT_EQ(name_of_format(city_text, ".osm"), "CityGML");
  EXPECT_EQ(name_of_format(osm_text, ".gml"), "OSM");
  EXPECT_EQ(name_of_format("glTF\x02", ".gml"), "glTF");
  EXPECT_EQ(name_of_format("  {\"asset\": {}}", ".txt"), "glTF");
  EXPECT_EQ(name_of_format("{ \"type\" : \"CityJSON\", \"asset\": 1}", ".gltf"), "CityJSON");
  EXPECT_EQ(name_of_format("{\"vertices\":[],\"CityObjects\":{}}", ".txt"), "CityJSON");
  EXPECT_EQ(name_of_format("{\"type\":\"CityJSONFeature\"}", ".json"), "CityJSON");
  EXPECT_EQ(name_of_format("NCLIGHTS", ".xml"), "light file");
  EXPECT_EQ(name_of_format("IESNA:LM-63-2002\n", ".txt"), "IES");
  EXPECT_EQ(name_of_format("a lamp\nTILT=NONE\n", ".txt"), "IES");
  EXPECT_EQ(name_of_format("no mark at all", ".LDT"), "EULUMDAT");
}

TEST(FileFormat, ARemedyThatLeadsToAModelIsForWhoWantsOne) {
  using city::explain_foreign, city::name_foreign;
  const std::string kml = "<kml xmlns=\"k\"/>", page = "<html><body/></html>";
  EXPECT_EQ(explain_foreign(kml, ""), "is KML: export the model as CityGML first");
  EXPECT_EQ(name_foreign(kml, ""), "is KML");
  EXPECT_EQ(name_foreign(page, ""), explain_foreign(page, ""));
  EXPECT_EQ(name_foreign("PAR1", ""),
            "is a Parquet table: export it as GeoPackage or CSV (ogr2ogr)");
  EXPECT_EQ(name_foreign("ARROW1", ""),
            "is an Arrow or Feather table: export it as GeoPackage or CSV (ogr2ogr)");
  EXPECT_EQ(name_foreign("Version 300\r\nCharset", ""),
            "is a MapInfo file: export it as GeoPackage or CSV (ogr2ogr)");
  EXPECT_EQ(
      name_foreign("INSERT INTO lamps VALUES (1);", ""),
      "is a dump of a database (SQL): export the table as CSV; a city model has to be exported "
      "as CityGML");
  EXPECT_EQ(name_foreign("RDX3\nX\n", ""), "is data of R: write the table as CSV (write.csv)");
  EXPECT_EQ(explain_foreign("<?xml version=\"1.0\"?><IESTM33-22><Version/></IESTM33-22>", ""),
            "is photometry in TM-33: it belongs in [[lamps.luminaires]]");
  EXPECT_EQ(explain_foreign("{\"version\":\"0.6\",\"generator\":\"CGImap\",\"elements\":[]}", ""),
            "is OpenStreetMap's data in JSON: a map belongs in [osm] files");
  // A name that holds the word is no remedy.
  EXPECT_EQ(name_foreign("<CityGMLReport a=\"1\"/>", ""),
            "is XML of another kind: its root element is <CityGMLReport>");
}

TEST(FileFormat, RegistersMeshesAndDumpsAreNamedWithTheirRemedy) {
  struct Case {
    std::string bytes;
    const char* name;
    const char* words;
  };
  for (const Case& c :
       {Case{"<AX_Bestandsdatenauszug xmlns=\"a\"/>", "", "a cadastre in NAS, not CityGML: "},
        Case{"<xplan:XPlanAuszug xmlns:xplan=\"a\"/>", "", "XPlanGML"},
        Case{"<vf:VymennyFormat xmlns:vf=\"a\"/>", "", "(VFR), not CityGML: "},
        Case{"<s:bagStand xmlns:s=\"a\"/>", "", "3DBAG has the same buildings as CityJSON"},
        Case{"<gbXML xmlns=\"a\"/>", "", "gbXML"}, Case{"<X3D/>", "", "is X3D: export it"},
        Case{"<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"/>", "",
             "3MF"},
        Case{"<house/>", "", "that of CityGML is <CityModel>"},
        Case{std::string("fcb\x01") + "fcb", "", "is FlatCityBuf: turn it into CityJSONSeq"},
        Case{"PGDMP\x01", "", "is a dump of a PostgreSQL database: restore it"},
        Case{"--\n-- PostgreSQL database dump\n--\n", "", "is a dump of a PostgreSQL database"},
        Case{"OFF\n3 1 0\n", "", "is OFF: export it"},
        Case{"3D Geometry File Format ", "", "is a Rhino file: export it"},
        Case{std::string(84, '\0'), "a.stl", "is named as a mesh"},
        Case{"\x08\x09", "a.dgn", "is named as a drawing: "},
        Case{"SET search_path", "a.sql", "is named as a dump of a database: "},
        Case{"INSERT INTO cityobject", "a.sql", "is a dump of a database (SQL): export"}}) {
    const std::string said = city::explain_foreign(c.bytes, c.name);
    EXPECT_NE(said.find(c.words), std::string::npos) << said;
  }
}

TEST(FileFormat, ContentDecidesInPackedFilesToo) {
  EXPECT_EQ(name_of_format("{\"version\":0.6,\"generator\":\"Overpass\",\"elements\":[]}", ".json"),
            "OSM");
  EXPECT_EQ(name_of_format(gzipped(city_text), ".osm.gz"), "CityGML");
  EXPECT_EQ(name_of_format(gzipped(osm_text), ".gml.gz"), "OSM");
  for (const std::string ending : test::stream_forms) {
    const test::TempFolder folder;
    test::pack_stream(folder / ("a" + ending), osm_text);
    EXPECT_STREQ(find_format(folder / ("a" + ending)).name, "OSM") << ending;
  }
  EXPECT_THROW(name_of_format(gzipped("glTF\x02"), ".glb.gz"), Error);  // no reader unpacks it
}

TEST(FileFormat, CityGmlIsRecognisedByItsRootElement) {
  EXPECT_EQ(name_of_format("<!-- <osm2city> -->\n<?pi x?><core:CityModel/>", ".gml"), "CityGML");
  EXPECT_EQ(name_of_format("\xEF\xBB\xBF<wfs:FeatureCollection a='1'>", ".gml"), "CityGML");
  for (const char* text : {"<Codelist><!-- CityModel --></Codelist>", "<CityModels/>", "<", "<!--",
                           "<!-- <CityModel> ", "x"})
    EXPECT_THROW(name_of_format(text, ".gml"), Error) << text;
}

TEST(FileFormat, EveryCityFormatHasAReaderAndEndingsOfItsOwn) {
  std::set<std::string_view> endings;
  for (const FileFormat& format : file_formats()) {
    // A map's buildings can be a city; but no folder is searched for maps.
    EXPECT_EQ(format.reader != nullptr,
              format.kind == FileKind::city || format.kind == FileKind::osm)
        << format.name;
    EXPECT_EQ(!format.endings.empty(), format.kind == FileKind::city) << format.name;
    for (const std::string_view ending : format.endings)
      EXPECT_TRUE(endings.insert(ending).second) << ending;
  }
}

TEST(FileFormat, MissingAndEmptyFilesAndFoldersAreErrors) {
  EXPECT_THROW(find_format("/nowhere/at/all.gml"), Error);
  EXPECT_THROW(find_format(std::filesystem::temp_directory_path()), Error);
  EXPECT_THROW(name_of_format("", ".gml"), Error);
}

std::string reason_for(const std::string& content, const std::string& ending) {
  try {
    name_of_format(content, ending);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

std::string zipped(const std::string& name, const std::string& content,
                   const std::vector<std::pair<std::string, std::string>>& more = {}) {
  const TemporaryFile file("", ".zip");
  zip_t* const zip = zip_open(file.path().c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  zip_file_add(zip, name.c_str(), zip_source_buffer(zip, content.data(), content.size(), 0), 0);
  for (const auto& [other, bytes] : more)
    zip_file_add(zip, other.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0);
  EXPECT_EQ(zip_close(zip), 0);
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FileFormat, WhatAnArchiveHoldsIsSaidOfItsEntry) {
  EXPECT_EQ(name_of_format(zipped("a/b.gml", city_text), ".zip"), "CityGML");
  const std::string other = reason_for(zipped("a/b.gml", "<a:Other>"), ".zip"),
                    text = reason_for(zipped("../b.gml", "hello"), ".zip");
  EXPECT_NE(other.find("/a/b.gml: is XML of another kind"), std::string::npos) << other;
  EXPECT_NE(text.find("/../b.gml: is of no format"), std::string::npos) << text;
  EXPECT_EQ(name_of_format(zipped("m/berlin.osm", "<osm version='0.6'/>"), ".zip"), "OSM");
  const std::string table = reason_for(zipped("m/berlin.dbf", "x"), ".zip");
  EXPECT_NE(table.find(", but m/berlin.dbf: unpack it and name what is inside"), std::string::npos)
      << table;
}

TEST(FileFormat, HiddenEntriesOfAnArchiveAreNoCities) {
  const std::string archive =
      zipped("a.gml", city_text, {{"__MACOSX/._a.gml", std::string("\0\5\26\7 Mac OS X", 13)}});
  const TemporaryFile file(archive, ".zip");
  EXPECT_STREQ(find_format(file.path()).name, "CityGML");
  std::size_t buildings = 0;
  read_city(file.path(), {}, [&](city::CityObject&&) { ++buildings; });
  EXPECT_EQ(buildings, 1u);
  const std::string json =
      "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{},\"vertices\":[]}";
  const TemporaryFile mixed(
      zipped("a.gml", city_text,
             {{"b.gml.gz", gzipped(city_text)}, {"c.zip", "PK"}, {"e.7z", "7z"}, {"d.json", json}}),
      ".zip");
  std::size_t objects = 0;
  const auto report = read_city(mixed.path(), {}, [&](city::CityObject&&) { ++objects; });
  EXPECT_EQ(objects, 2u) << "that in the gzip stream too";
  ASSERT_EQ(report.warnings.size(), 2u);
  EXPECT_NE(report.warnings[0].find("2 packed files inside were passed over (first c.zip)"),
            std::string::npos);
  EXPECT_NE(report.warnings[1].find("1 city models of other formats than CityGML"),
            std::string::npos);
  const std::string nested = zipped("tiles/inner.zip", archive);
  EXPECT_EQ(name_of_format(nested, ".zip"), "CityGML");
  const std::string deep = reason_for(zipped("deep.zip", nested), ".zip");
  EXPECT_NE(deep.find("another packed file (deep.zip/tiles/inner.zip)"), std::string::npos) << deep;
}

TEST(FileFormat, BrokenStreamsInArchivesAreNamed) {
  const std::string stream = gzipped(city_text);
  const auto why = [&](const std::string& bytes) {
    const TemporaryFile file(zipped("a.gml.gz", bytes), ".zip");
    try {
      read_city(file.path(), {}, [](city::CityObject&&) {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  EXPECT_EQ(why(stream), "was read");
  for (const std::size_t size : {stream.size() / 2, stream.size() - 4})
    EXPECT_NE(why(stream.substr(0, size)).find("/a.gml: broken gzip stream: truncated"),
              std::string::npos)
        << why(stream.substr(0, size));
  EXPECT_EQ(why(city_text), "was read") << "as servers unpack files on their way";
}

TEST(FileFormat, FilesWithoutAMarkAreToldByTheirNames) {
  EXPECT_NE(reason_for("1 2 3\n", ".xyz").find("[terrain] dem"), std::string::npos);
  EXPECT_NE(reason_for("id,lon,lat\n", ".csv").find("[[lamps.inventories]]"), std::string::npos);
  EXPECT_NE(reason_for(zipped("a/dem.tif", "II*"), ".zip").find("a/dem.tif: heights belong in"),
            std::string::npos);
}

TEST(FileFormat, TextMayBeUtf32) {
  for (const bool big_endian : {false, true}) {
    std::string wide = big_endian ? std::string("\0\0\xfe\xff", 4) : std::string("\xff\xfe\0\0", 4);
    for (const char c : city_text) {
      std::string unit = {c, '\0', '\0', '\0'};
      wide += big_endian ? std::string(unit.rbegin(), unit.rend()) : unit;
    }
    EXPECT_EQ(name_of_format(wide, ".gml"), "CityGML") << big_endian;
  }
}

TEST(FileFormat, LuminairesAreToldByTheirContent) {
  EXPECT_EQ(name_of_format("TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n", ".txt"), "IES");
  EXPECT_EQ(name_of_format("Maker\r\n1\r\n1\r\n24\r\n15\r\n19\r\n5\r\nreport\r\n", ".txt"),
            "EULUMDAT");
}

TEST(FileFormat, WhatAFileIsNotIsSaidWithTheRemedy) {
  using namespace std::string_literals;
  const std::string tar =
      "a.gml" + std::string(252, '\0') + "ustar\0"s + std::string(250, '\0') + city_text;
  struct Case {
    std::string content, ending, words;
  };
  for (const Case& c : {
           Case{tar, ".tar", "broken tar archive"},
           Case{gzipped(tar), ".tgz", "broken tar archive"},
           Case{"\xFD"
                "7zXZ\0"s,
                ".gml.xz", "broken xz stream"},
           Case{"BZh91AY", ".gml.bz2", "broken bzip2 stream"},
           Case{"\x1F\x9D\x90", ".gml.Z", "is packed by compress: unpack it first"},
           Case{"PK", ".zip", "no zip archive"},
           Case{"hello", ".zip", "no zip archive"},
           Case{"{\"recipe\": 1}", ".json", "is JSON of another kind"},
           Case{"{\"asset\":{},\"geometricError\":1,\"root\":{}}", ".json", "3D Tiles"},
           Case{"<!DOCTYPE html><html><body/></html>", ".gml", "is a web page"},
           Case{"\n<HTML >", ".xml", "is a web page"},
           Case{"<osmChange version='0.6'>", ".osc", "change file"},
           Case{"<base:SpatialDataSet xmlns:base='b'>", ".gml", "INSPIRE"},
           Case{"<ows:ExceptionReport>", ".gml", "reports an error"},
           Case{"<gml:Dictionary>", ".xml", "is a code list"},
           Case{"<a:Other>", ".xml", "root element is <Other>"},
           Case{"<ogr:FeatureCollection xmlns:ogr='o'><gml:featureMember><ogr:houses/>", ".gml",
                "is GML, but not CityGML"},
           Case{"<wfs:FeatureCollection xmlns:bu='http://inspire.ec.europa.eu/bu'><wfs:member>",
                ".gml", "is INSPIRE data"},
           Case{"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", ".dxf", "is a drawing (DXF)"},
           Case{"Kaydara FBX Binary  ", ".fbx", "is FBX"},
           Case{"ply\nformat ascii 1.0\n", ".ply", "is PLY"},
           Case{"fgb\3fgb", ".fgb", "is FlatGeobuf"},
           Case{"{\"type\":\"Feature\",\"geometry\":{}}", ".json", "is GeoJSON"},
           Case{"{\"type\":\"CityJSONExtension\"}", ".json", "is an extension of CityJSON"},
           Case{gzipped(gzipped("hello")), ".gz", "by gzip twice"},
           Case{zipped("[Content_Types].xml", "<Types/>"), ".xlsx", "save a table as CSV"},
       }) {
    const std::string said = reason_for(c.content, c.ending);
    EXPECT_NE(said.find(c.words), std::string::npos) << c.words << ": " << said;
  }
}

}  // namespace
}  // namespace nightcity::inputs
