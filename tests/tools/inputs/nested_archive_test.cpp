// Archives in archives, and what else than a city model an archive may hold.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tests/tools/city/read_city.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/inputs/city_files.h"
#include "tools/inputs/file_format.h"
#include "tools/inputs/read_city.h"

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using Files = test::ZipFiles;

// Returns the bytes of an archive.
std::string pack(const Files& files) {
  const test::TempFolder folder;
  test::pack_zip(folder / "a.zip", files);
  return test::read_text(folder / "a.zip");
}

class NestedArchive : public testing::Test {
 protected:
  fs::path write(const Files& files) {
    const fs::path path = folder_ / "all.zip";
    test::pack_zip(path, files);
    return path;
  }
  static std::string pack_house(const std::string& id) {
    return pack({{"data/" + id + ".gml", house(id)}});
  }
  static std::string house(const std::string& id) {
    return test::city_model(test::member(test::building(id)));
  }
  static std::string ids_of(const fs::path& file) {
    test::City city;
    const auto sink = city.sink();
    city.report = read_city(file, {}, sink);
    std::string ids;
    for (const city::CityObject& object : city.objects) ids += object.id + " ";
    return ids;
  }
  test::TempFolder folder_;
};

TEST_F(NestedArchive, CityModelsInArchivesInItAreReadInTheirOrder) {
  EXPECT_EQ(ids_of(write({{"tiles/one.zip", pack_house("a")}})), "a ");
  const fs::path all =
      write({{"1.zip", pack_house("a")}, {"2.gml", house("b")}, {"sub/3.ZIP", pack_house("c")}});
  EXPECT_EQ(ids_of(all), "a b c ");
  EXPECT_EQ(find_format(all).kind, FileKind::city);
  // The same again: what has been unpacked may have been kept.
  EXPECT_EQ(ids_of(all), "a b c ");
}

TEST_F(NestedArchive, AnArchiveThatIsWrittenAnewIsReadAnew) {
  EXPECT_EQ(ids_of(write({{"one.zip", pack_house("a")}})), "a ");
  EXPECT_EQ(ids_of(write({{"one.zip", pack_house("b")}})), "b ");
}

TEST_F(NestedArchive, ArchivesDeeperThanThatAndOthersAreNamed) {
  const std::string deep = pack({{"in.zip", pack_house("a")}});
  EXPECT_NE(message_of([&] {
              find_format(write({{"deep.zip", deep}}));
            }).find("another packed file (deep.zip/in.zip)"),
            std::string::npos);
  const std::string whole = pack_house("a");
  EXPECT_NE(message_of([&] {
              find_format(write({{"cut.zip", whole.substr(0, whole.size() / 2)}}));
            }).find("all.zip/cut.zip: broken zip archive"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              find_format(write({{"no.zip", "x"}}));
            }).find("packed file (no.zip)"),
            std::string::npos);
  EXPECT_EQ(ids_of(write({{"docs.zip", pack({{"a.pdf", "%PDF"}})}, {"a.gml", house("a")}})), "a ");
}

TEST_F(NestedArchive, RastersOfHeightsAndKmlAreNamed) {
  EXPECT_NE(message_of([&] {
              find_format(write({{"in.zip", pack({{"dem.tif", "II*"}})}}));
            }).find("in.zip/dem.tif: heights belong in [terrain] dem"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              find_format(write({{"doc.kml", "<kml/>"}}));
            }).find("holds KML (doc.kml)"),
            std::string::npos);
}

TEST_F(NestedArchive, AMapIsAMapUnlessACityIsBeside) {
  const std::string map = "<osm version=\"0.6\"/>";
  EXPECT_EQ(find_format(write({{"map.osm", map}})).kind, FileKind::osm);
  EXPECT_EQ(find_format(write({{"map.osm", map}, {"a.gml", house("a")}})).kind, FileKind::city);
  EXPECT_EQ(ids_of(folder_ / "all.zip"), "a ");
}

// Portals put documents and rasters beside their models, packed too.
TEST_F(NestedArchive, OtherArchivesInAFolderArePassedOver) {
  test::write_text(folder_ / "a.gml", house("a"));
  test::pack_zip(folder_ / "doc.zip", {{"a.pdf", "%PDF"}});
  test::pack_zip(folder_ / "dem.zip", {{"a.tif", "II*"}});
  test::pack_zip(folder_ / "map.zip", {{"map.osm", "<osm version=\"0.6\"/>"}});
  EXPECT_EQ(city_files(folder_.path()), std::vector<fs::path>{folder_ / "a.gml"});
  EXPECT_EQ(find_reason_to_pass_over(folder_ / "map.zip"), "is OSM");
  EXPECT_NE(find_reason_to_pass_over(folder_ / "dem.zip").find("a.tif: heights belong in"),
            std::string::npos);
  fs::remove(folder_ / "a.gml");
  EXPECT_NE(message_of([&] { city_files(folder_.path()); }).find("no city model in this folder"),
            std::string::npos);
}

TEST_F(NestedArchive, WhatIsPassedOverInsideIsCountedByWhatItIs) {
  const fs::path all = write({{"a.gml", house("a")},
                              {"doc/a.PDF", "%PDF"},
                              {"doc/b.pdf", "%PDF"},
                              {"in.zip", pack({{"LIESMICH", "x"}, {"deep.7z", "7z"}})},
                              {"meta.xml", "<gmd:MD_Metadata/>"},
                              {"m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                              {"map.osm", "<osm version=\"0.6\"/>"}});
  const city::ReadReport report = read_city(all, {}, [](city::CityObject&&) {});
  const std::map<std::string, std::size_t> expected{{".pdf", 2},          {"liesmich", 1},
                                                    {".7z", 1},           {"<MD_Metadata>", 1},
                                                    {"Wavefront OBJ", 1}, {"OSM", 1}};
  EXPECT_EQ(report.passed_over, expected);
  EXPECT_TRUE(
      read_city(write({{"a.gml", house("a")}}), {}, [](city::CityObject&&) {}).passed_over.empty());
}

// A city may lie in each of them.
TEST_F(NestedArchive, BrokenArchivesOfAllKindsAreToldInFoldersToo) {
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"a.7z", std::string("7z\xBC\xAF\x27\x1C") + std::string(40, '\4')},
      {"a.rar", std::string("Rar!\x1A\x07\x01") + std::string(40, '\0')},
      {"a.tar", std::string(257, 'a') + "ustar" + std::string(250, '\0')},
      {"a.tar.bz2", "BZh91AY&SY"},
      {"a.txz", std::string("\xFD"
                            "7zXZ\0",
                            6)}};
  for (const auto& [name, bytes] : kinds) {
    test::write_text(folder_ / name, bytes);
    for (const auto& what : {folder_ / name, folder_.path()}) {
      const std::string message = message_of([&] { find_format(city_files(what).front()); });
      EXPECT_NE(message.find(name), std::string::npos) << message;
      EXPECT_NE(message.find("broken"), std::string::npos) << message;
    }
    fs::remove(folder_ / name);
  }
}

TEST_F(NestedArchive, ModelsOfOtherProgramsAreNamedWithTheRemedy) {
  const auto message = [&](const std::string& name, const std::string& bytes) {
    test::write_text(folder_ / name, bytes);
    return message_of([&] { find_format(folder_ / name); });
  };
  EXPECT_NE(message("a.skp", "\xFF\xFE\xFF\x0E").find("export it as Wavefront OBJ"),
            std::string::npos);
  EXPECT_NE(message("a.wrl", "#VRML V2.0 utf8\n").find("is VRML: export it"), std::string::npos);
  EXPECT_NE(message_of([&] {
              find_format(write({{"a.ifc", "ISO-10303-21;\n"}}));
            }).find("but a.ifc, which is IFC or another STEP file: export it"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              find_format(write({{"3dSceneLayer.json", "{\"layerType\":\"3DObject\"}"}}));
            }).find("is a scene layer of I3S: the CityGML"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::inputs
