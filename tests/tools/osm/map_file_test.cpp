// Maps in archives and streams.
#include "tools/osm/map_file.h"

#include <gtest/gtest.h>

#include <string>

#include "support/error_message.h"
#include "support/pack_archive.h"
#include "support/temp_folder.h"
#include "tools/osm/first_nodes.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

using test::message_of;
using test::pack_zip;

constexpr const char* map =
    "<osm version='0.6'><node id='1' lat='1' lon='2'><tag k='highway' v='street_lamp'/></node>"
    "<node id='2' lat='1' lon='2.001'/><node id='3' lat='1.001' lon='2'/>"
    "<way id='7'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='1'/>"
    "<tag k='building' v='yes'/></way></osm>";

TEST(MapFile, AMapIsReadInTheArchiveThatHoldsIt) {
  const test::TempFolder folder;
  const auto path = folder / "m.zip";
  for (const char* name : {"map.osm", "extract/map.osm", "export.xml"}) {
    pack_zip(path, {{name, map}, {"LICENCE.txt", "ODbL"}, {"meta.xml", "<metadata/>"}});
    const OsmData data = read_osm(path);
    ASSERT_EQ(data.lamps.size(), 1u) << name;
    EXPECT_EQ(data.buildings.size(), 1u);
    EXPECT_EQ(read_map_areas(path, {{"building"}}, 100).areas.size(), 1u);
    EXPECT_EQ(read_first_nodes(path, 1).size(), 1u);
  }
}

TEST(MapFile, EveryFormOfArchiveAndStreamHoldsTheSameMap) {
  const test::TempFolder folder;
  const auto expect_map = [](const std::filesystem::path& path) {
    const OsmData data = read_osm(path);
    ASSERT_EQ(data.lamps.size(), 1u) << path;
    EXPECT_EQ(data.lamps[0].lon_lat, glm::dvec2(2, 1)) << path;
    EXPECT_EQ(data.buildings.size(), 1u) << path;
    EXPECT_EQ(read_map_areas(path, {{"building"}}, 100).areas.size(), 1u) << path;
    EXPECT_EQ(read_first_nodes(path, 1).size(), 1u) << path;
  };
  for (const char* form : test::archive_forms) {
    const auto path = folder / ("m" + std::string(form));
    test::pack_archive(path, {{"LICENCE.txt", "ODbL"}, {"extract/map.osm", map}});
    expect_map(path);
  }
  for (const char* form : test::stream_forms) {
    const auto path = folder / ("m.osm" + std::string(form));
    test::pack_stream(path, map);
    expect_map(path);
    test::pack_archive(folder / "m.tar", {{"map.osm" + std::string(form), test::read_text(path)}});
    expect_map(folder / "m.tar");
  }
}

TEST(MapFile, ErrorsNameTheMapAndNotWhereItWasUnpacked) {
  const test::TempFolder folder;
  const auto path = folder / "m.zip";
  const std::string name = path.string() + "/a.osm:", cut = std::string(map).substr(0, 90);
  pack_zip(path, {{"a.osm", cut}});
  for (const std::string& why : {message_of([&] { read_osm(path); }),
                                 message_of([&] { read_map_areas(path, {{"building"}}, 100); }),
                                 message_of([&] { read_first_nodes(path, 1); })}) {
    EXPECT_TRUE(why.starts_with(name)) << why;
    EXPECT_EQ(why.find("/proc/"), std::string::npos) << why;
  }
  pack_zip(path, {{"a.osm", "<osmChange/>"}});
  EXPECT_NE(message_of([&] { read_osm(path); }).find("change file"), std::string::npos);
}

TEST(MapFile, ArchivesWithoutOneMapAreRefused) {
  const test::TempFolder folder;
  const auto path = folder / "m.zip";
  const auto why = [&] { return message_of([&] { read_osm(path); }); };
  pack_zip(path, {{"a.osm", map}, {"b/c.osm", map}});
  EXPECT_NE(why().find("holds 2 maps (a.osm, b/c.osm): unpack it"), std::string::npos) << why();
  pack_zip(path, {{"readme.txt", "x"}});
  EXPECT_NE(why().find("holds no .osm"), std::string::npos) << why();
  pack_zip(path, {{"a.xml", "<metadata/>"}});
  EXPECT_NE(why().find("no map"), std::string::npos) << why();
}

}  // namespace
}  // namespace nightcity::osm
