#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "formats/error.h"
#include "support/data.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/read_osm.h"

namespace nightcity {
namespace {

class OsmFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("nightcity_osm_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text, const char* name = "a.osm") {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  OsmData read(const std::string& elements) {
    return read_osm(write("<?xml version='1.0'?><osm>" + elements + "</osm>"));
  }
  std::string error_of(const std::filesystem::path& path) {
    try {
      read_osm(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::bad_data);
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(OsmFile, LampsHighwaysAndBuildingsComeWithTagsAndPlaces) {
  const OsmData data = read(R"(
    <node id="1" lat="52.5" lon="13.4"><tag k="highway" v="street_lamp"/><tag k="lamp_type" v="LED"/></node>
    <node id="2" lat="52.6" lon="13.5"/><node id="3" lat="52.7" lon="13.6"/><node id="4" lat="-1" lon="-180"/>
    <node id="5" lat="1" lon="2"><tag k="amenity" v="bench"/></node>
    <way id="10"><nd ref="2"/><nd ref="3"/><tag k="highway" v="residential"/></way>
    <way id="11"><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="2"/><tag k="building" v="yes"/></way>
    <way id="12"><nd ref="2"/><nd ref="3"/><tag k="waterway" v="river"/></way>
    <relation id="20"/>)");
  ASSERT_EQ(data.lamps.size(), 1u);
  EXPECT_EQ(data.lamps[0].id, 1);
  EXPECT_EQ(data.lamps[0].lon_lat, glm::dvec2(13.4, 52.5));
  EXPECT_EQ(data.lamps[0].tags.at("lamp_type"), "LED");
  ASSERT_EQ(data.highways.size(), 1u);
  ASSERT_EQ(data.highways[0].lon_lat.size(), 2u);
  EXPECT_NEAR(data.highways[0].lon_lat[1].x, 13.6, 1e-9);
  EXPECT_NEAR(data.highways[0].lon_lat[1].y, 52.7, 1e-9);
  ASSERT_EQ(data.buildings.size(), 1u);
  EXPECT_EQ(data.buildings[0].lon_lat.size(), 4u);
  EXPECT_EQ(data.nodes, 5u);
  EXPECT_EQ(data.ways, 3u);
  EXPECT_EQ(data.relations, 1u);
  EXPECT_EQ(data.missing_nodes + data.bad_coordinates + data.duplicates, 0u);
}

TEST_F(OsmFile, BrokenNumbersMissingNodesDeletedAndRepeatedElementsAreCounted) {
  const OsmData data = read(R"(
    <way id="10"><nd ref="2"/><nd ref="3"/><nd ref="99"/><nd ref="x"/><tag k="highway" v="primary"/></way>
    <way id="11"><nd ref="98"/><nd ref="2"/><tag k="highway" v="primary"/></way>
    <way id="10"><nd ref="3"/><nd ref="2"/><tag k="highway" v="primary"/></way>
    <node id="1" lat="52,5" lon="13.4"><tag k="highway" v="street_lamp"/></node>
    <node id="2" lat="52.6" lon="13.5"/><node id="3" lat="52.7" lon="13.6"/>
    <node id="4" lat="95" lon="13.4"><tag k="highway" v="street_lamp"/></node>
    <node id="5" lat="nan" lon="13.4"><tag k="highway" v="street_lamp"/></node>
    <node id="6" lon="13.4"/><node lat="1" lon="1"/>
    <node id="7" lat="1" lon="1"><tag k="highway" v="street_lamp"/></node>
    <node id="7" lat="2" lon="2"><tag k="highway" v="street_lamp"/></node>
    <node id="8" lat="1" lon="1" action="delete"><tag k="highway" v="street_lamp"/></node>
    <node id="9" lat="1" lon="1" visible="false"><tag k="highway" v="street_lamp"/></node>)");
  EXPECT_EQ(data.bad_coordinates, 5u);
  EXPECT_EQ(data.missing_nodes, 3u);
  EXPECT_EQ(data.duplicates, 2u);
  ASSERT_EQ(data.lamps.size(), 1u);
  EXPECT_EQ(data.lamps[0].lon_lat, glm::dvec2(1, 1));
  ASSERT_EQ(data.highways.size(), 1u);
  EXPECT_EQ(data.highways[0].lon_lat.size(), 2u);
}

TEST_F(OsmFile, MergeKeepsEachElementOnce) {
  const std::string lamp =
      R"(<node id="1" lat="1" lon="1"><tag k="highway" v="street_lamp"/></node>)";
  OsmData a = read(lamp);
  a.merge(read(lamp + R"(<node id="2" lat="1" lon="1"><tag k="highway" v="street_lamp"/></node>)"));
  EXPECT_EQ(a.lamps.size(), 2u);
  EXPECT_EQ(a.duplicates, 1u);
  EXPECT_EQ(a.nodes, 3u);
}

TEST_F(OsmFile, EveryUnusableFileIsAnErrorThatNamesIt) {
  EXPECT_NE(error_of(folder_ / "absent.osm").find("absent.osm: no such file"), std::string::npos);
  EXPECT_NE(error_of(folder_).find("not a file"), std::string::npos);
  EXPECT_NE(error_of(write("")).find("empty"), std::string::npos);
  EXPECT_NE(error_of(write("hello")).find("not OSM data"), std::string::npos);
  EXPECT_NE(error_of(write("<html></html>")).find("<osm>"), std::string::npos);
  EXPECT_NE(error_of(write("<osm>\n<node id='1'\n")).find(":2: "), std::string::npos);
  EXPECT_NE(error_of(write("<osm><node></osm>")).find(":1: "), std::string::npos);
  EXPECT_NE(error_of(write("<!DOCTYPE osm [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><osm/>"))
                .find("DOCTYPE"),
            std::string::npos);
  EXPECT_NE(error_of(write("\x1f\x8b rubbish", "a.osm.gz")).find("broken osm.gz"),
            std::string::npos);
  EXPECT_NE(error_of(write("BZh9 rubbish", "a.osm.bz2")).find("broken osm.bz2"), std::string::npos);
  EXPECT_NE(error_of(write(std::string("\0\0\0\x0d\x0a\x09OSMHeader rubbish", 23), "a.osm.pbf"))
                .find("broken pbf"),
            std::string::npos);
}

TEST_F(OsmFile, GzipAndBzip2GiveTheSameAsPlain) {
  const std::string text =
      "<?xml version='1.0'?><osm version='0.6'><node id='1' lat='52.5' lon='13.4'><tag k='highway' "
      "v='street_lamp'/>"
      "</node></osm>";
  for (const char* packer : {"gzip", "bzip2"}) {
    const std::filesystem::path path = write(text, "b.osm");
    if (std::system((std::string(packer) + " -f " + path.string()).c_str()) != 0)
      GTEST_SKIP() << "no " << packer;
    const OsmData data = read_osm(path.string() + (packer[0] == 'g' ? ".gz" : ".bz2"));
    ASSERT_EQ(data.lamps.size(), 1u);
    EXPECT_NEAR(data.lamps[0].lon_lat.x, 13.4, 1e-9);
  }
}

TEST(OsmSelection, LampsAsPeopleSpellThem) {
  for (const OsmTags& tags :
       std::vector<OsmTags>{{{"highway", "street_lamp"}},
                            {{"highway", "Street Lamp"}},
                            {{"man_made", "street-light"}},
                            {{"light_source", "lantern"}},
                            {{"light_source", "floodlight"}},
                            {{"man_made", "tower"}, {"tower:type", "lighting"}}})
    EXPECT_TRUE(is_lamp(tags));
  for (const OsmTags& tags :
       std::vector<OsmTags>{{},
                            {{"highway", "traffic_signals"}},
                            {{"light_source", "warning"}},
                            {{"man_made", "tower"}, {"tower:type", "communication"}}})
    EXPECT_FALSE(is_lamp(tags));
  EXPECT_FALSE(is_highway({{"highway", "street_lamp"}}));
  EXPECT_TRUE(is_highway({{"highway", "footway"}}));
  EXPECT_FALSE(is_building({{"building", "no"}}));
}

// Counts found by another reader (the index of the data; a building there may be a relation, here
// it is a way).
TEST(OsmReal, BerlinXml) {
  REAL_DATA(file, "berlin/ayushd47_berlin.osm");
  const OsmData data = read_osm(file);
  EXPECT_EQ(data.lamps.size(), 151u);
  EXPECT_EQ(data.highways.size(), 473u);
  EXPECT_EQ(data.buildings.size(), 379u);
  EXPECT_GE(data.relations, 32u);
}

TEST(OsmReal, BerlinPbf) {
  REAL_DATA(file, "berlin/berlin_dev_box.osm.pbf");
  const OsmData data = read_osm(file);
  EXPECT_EQ(data.lamps.size(), 245u + 15u);  // street lamps, and masts with tower:type=lighting
  EXPECT_EQ(data.highways.size(), 820u);
}

TEST(OsmReal, BayreuthGzip) {
  REAL_DATA(file, "osm/north-bayreuth.osm.gz");
  const OsmData data = read_osm(file);
  EXPECT_EQ(data.lamps.size(), 0u);
  EXPECT_EQ(data.highways.size(), 2056u);
}

TEST(OsmReal, CorruptPbfIsAnError) {
  REAL_DATA(file, "osm/corrupt.osm.pbf");
  EXPECT_THROW(read_osm(file), Error);
}

}  // namespace
}  // namespace nightcity
