// Heights written back leave everything else as it was.
#include "tools/elevation/osm_elevations.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/osm/read_osm.h"

namespace nightcity::elevation {
namespace {

constexpr const char* map = R"(<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6" generator="somebody">
  <!-- a note -->
  <node id="1" lat="52.5" lon="13.4" version="3" user="Jörg" action="modify"><tag k="highway" v="street_lamp"/></node>
  <node id="2" lat="52.6" lon="13.5"><tag k="ele" v="wrong"/><tag k="highway" v="street_lamp"/></node>
  <node id="3" lat="52.7" lon="13.6"><tag k="highway" v="street_lamp"/></node>
  <way id="9"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/></way>
</osm>
)";

std::string ele_of(const osm::OsmData& data, std::int64_t id) {
  for (const osm::OsmLampNode& lamp : data.lamps)
    if (lamp.id == id) return lamp.tags.contains("ele") ? lamp.tags.at("ele") : "";
  return "no such lamp";
}

TEST(OsmElevations, XmlKeepsEverythingElse) {
  const test::TempFolder folder;
  test::write_text(folder / "in.osm", map);
  EXPECT_EQ(
      write_elevations(folder / "in.osm", folder / "out.osm", {{1, 34.567}, {2, -1}, {77, 5}}), 2u);
  const osm::OsmData data = osm::read_osm(folder / "out.osm");
  EXPECT_EQ(ele_of(data, 1), "34.57");
  EXPECT_EQ(ele_of(data, 2), "-1.00");
  EXPECT_EQ(ele_of(data, 3), "");
  EXPECT_EQ(data.highways.size(), 1u);
  const std::string text = test::read_text(folder / "out.osm");
  for (const char* kept :
       {"<!-- a note -->", "user=\"Jörg\"", "action=\"modify\"", "generator=\"somebody\""})
    EXPECT_NE(text.find(kept), std::string::npos) << kept;
  EXPECT_EQ(text.find("wrong"), std::string::npos);
  // The same with its own file as output.
  EXPECT_EQ(write_elevations(folder / "out.osm", folder / "out.osm", {{3, 7}}), 1u);
  EXPECT_EQ(ele_of(osm::read_osm(folder / "out.osm"), 1), "34.57");
}

TEST(OsmElevations, PackedFilesKeepElementsAndTags) {
  const test::TempFolder folder;
  test::write_text(folder / "in.osm", map);
  for (const char* name : {"out.osm.pbf", "out.osm.gz", "out.osm.bz2"}) {
    EXPECT_EQ(write_elevations(folder / "in.osm", folder / name, {{1, 34.567}, {2, 8}}), 2u)
        << name;
    const osm::OsmData data = osm::read_osm(folder / name);
    EXPECT_EQ(ele_of(data, 1), "34.57") << name;
    EXPECT_EQ(ele_of(data, 2), "8.00") << name;
    EXPECT_EQ(ele_of(data, 3), "") << name;
    ASSERT_EQ(data.highways.size(), 1u);
    EXPECT_EQ(data.highways[0].lon_lat.size(), 2u);
  }
  EXPECT_EQ(write_elevations(folder / "out.osm.pbf", folder / "back.osm", {}), 0u);
  EXPECT_EQ(ele_of(osm::read_osm(folder / "back.osm"), 2), "8.00");
}

TEST(OsmElevations, FailuresNameTheFileAndLeaveNothing) {
  const test::TempFolder folder;
  test::write_text(folder / "in.osm", map);
  test::write_text(folder / "cut.osm", std::string(map).substr(0, 300));
  const std::size_t before = folder.entries();
  EXPECT_THROW(write_elevations(folder / "in.osm", folder / "out.txt", {}), Error);
  EXPECT_THROW(write_elevations(folder / "in.osm", folder / "none/out.osm", {}), Error);
  EXPECT_THROW(write_elevations(folder / "in.osm", folder / "none/out.osm.pbf", {}), Error);
  EXPECT_THROW(write_elevations(folder / "cut.osm", folder / "out.osm", {}), Error);
  EXPECT_THROW(write_elevations(folder / "cut.osm", folder / "out.osm.pbf", {}), Error);
  EXPECT_EQ(folder.entries(), before);
}

TEST(OsmElevationsReal, EveryBerlinLampCanBeGivenAHeight) {
  REAL_DATA(file, "berlin/berlin_dev_box.osm.pbf");
  const test::TempFolder folder;
  const osm::OsmData data = osm::read_osm(file);
  std::map<std::int64_t, double> heights;
  for (const osm::OsmLampNode& lamp : data.lamps) heights[lamp.id] = 34;
  EXPECT_EQ(write_elevations(file, folder / "out.osm.pbf", heights), heights.size());
  const osm::OsmData again = osm::read_osm(folder / "out.osm.pbf");
  EXPECT_EQ(again.nodes, data.nodes);
  EXPECT_EQ(again.highways.size(), data.highways.size());
  for (const osm::OsmLampNode& lamp : again.lamps) EXPECT_EQ(lamp.tags.at("ele"), "34.00");
}

}  // namespace
}  // namespace nightcity::elevation
