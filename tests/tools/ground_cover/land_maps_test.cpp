// Land as maps hold it: in multipolygons, broken outlines and answers of servers.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support/temp_folder.h"
#include "tests/tools/ground_cover/metre_map.h"
#include "tools/ground_cover/land_areas.h"

namespace nightcity::ground_cover {
namespace {

// A lake with an island as a multipolygon, one that lacks a way, a ring that crosses itself and an
// open way.
TEST(LandAreas, ReadsMultipolygonsAndCountsWhatIsBroken) {
  const test::TempFolder folder;
  std::ofstream(folder / "map.osm") << R"(<osm version="0.6">
<node id="1" lon="0" lat="0" version="1"/><node id="2" lon="9" lat="0" version="1"/>
<node id="3" lon="9" lat="9" version="1"/><node id="4" lon="0" lat="9" version="1"/>
<node id="5" lon="3" lat="3" version="1"/><node id="6" lon="6" lat="3" version="1"/>
<node id="7" lon="6" lat="6" version="1"/><node id="8" lon="3" lat="6" version="1"/>
<way id="1" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/></way>
<way id="2" version="1"><nd ref="3"/><nd ref="4"/><nd ref="1"/></way>
<way id="3" version="1"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="8"/><nd ref="5"/></way>
<way id="4" version="1"><nd ref="1"/><nd ref="2"/><nd ref="4"/><nd ref="3"/><nd ref="1"/>
  <tag k="landuse" v="grass"/></way>
<way id="5" version="1"><nd ref="1"/><nd ref="2"/><tag k="natural" v="wood"/></way>
<way id="6" version="1"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="5"/>
  <tag k="highway" v="residential"/></way>
<relation id="1" version="1"><member type="way" ref="1" role="outer"/>
  <member type="way" ref="2" role="outer"/><member type="way" ref="3" role="inner"/>
  <tag k="type" v="multipolygon"/><tag k="natural" v="water"/></relation>
<relation id="2" version="1"><member type="way" ref="1" role="outer"/>
  <member type="way" ref="99" role="outer"/>
  <tag k="type" v="multipolygon"/><tag k="natural" v="water"/></relation>
</osm>)";
  const osm::MapAreas map = osm::read_map_areas(folder / "map.osm", select_land(), 1000);
  ASSERT_EQ(map.areas.size(), 1u);
  EXPECT_EQ(map.areas[0].id, "relation/1");
  ASSERT_EQ(map.areas[0].rings.size(), 1u);
  EXPECT_EQ(map.areas[0].rings[0].outer.size(), 4u);
  EXPECT_EQ(map.areas[0].rings[0].holes.size(), 1u);
  EXPECT_EQ(map.broken, 2u);
  EXPECT_EQ(map.open_ways, 1u);
  Cover cover;
  add_land(map.areas, as_metres, bounds, cover);
  cover.finish();
  EXPECT_FALSE(mesh::holds(cover.areas().at(0).rings, {4.5, 4.5}));
  EXPECT_TRUE(mesh::holds(cover.areas().at(0).rings, {1, 4.5}));
}

// A lake of two ways with an island, in the orders and forms in which Overpass answers.
TEST(LandAreas, AnswersOfOverpassHaveTheirAreasInAnyOrder) {
  const std::string nodes = R"(
<node id="3" lon="9" lat="9"/><node id="1" lon="0" lat="0"/><node id="2" lon="9" lat="0"/>
<node id="4" lon="0" lat="9"/><node id="5" lon="3" lat="3"/><node id="6" lon="6" lat="3"/>
<node id="7" lon="6" lat="6"/><node id="8" lon="3" lat="6"/>)";
  const std::string ways = R"(
<way id="3"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="8"/><nd ref="5"/></way>
<way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/></way>
<way id="2"><nd ref="3"/><nd ref="4"/><nd ref="1"/></way>)";
  const std::string relation = R"(<relation id="1"><member type="way" ref="1" role="outer"/>
  <member type="way" ref="2" role="outer"/><member type="way" ref="3" role="inner"/>
  <tag k="type" v="multipolygon"/><tag k="natural" v="water"/></relation>)";
  const std::string with_places = R"(<relation id="1"><bounds minlat="0"/>
  <member type="way" ref="1" role="outer"><nd lat="0" lon="0"/><nd lat="0" lon="9"/>
    <nd lat="9" lon="9"/></member>
  <member type="way" ref="2" role="outer"><nd lat="9" lon="9"/><nd lat="9" lon="0"/>
    <nd lat="0" lon="0"/></member>
  <member type="way" ref="3" role="inner"><nd lat="3" lon="3"/><nd lat="3" lon="6"/>
    <nd lat="6" lon="6"/><nd lat="6" lon="3"/><nd lat="3" lon="3"/></member>
  <tag k="type" v="multipolygon"/><tag k="natural" v="water"/></relation>)";
  const std::string centre = R"(<way id="9"><center lat="1" lon="1"/><nd ref="1"/>
  <tag k="natural" v="wood"/></way>)";
  const test::TempFolder folder;
  for (const std::string& content :
       {nodes + ways + relation, ways + relation + nodes, relation + ways + nodes, with_places,
        ways + with_places, nodes + ways + relation + centre}) {
    std::ofstream(folder / "map.osm")
        << "<osm version=\"0.6\" generator=\"Overpass API\">" << content << "</osm>";
    const osm::MapAreas map = osm::read_map_areas(folder / "map.osm", select_land(), 1000);
    ASSERT_EQ(map.areas.size(), 1u) << content;
    EXPECT_EQ(map.areas[0].id, "relation/1");
    ASSERT_EQ(map.areas[0].rings.size(), 1u);
    EXPECT_EQ(map.areas[0].rings[0].outer.size(), 4u);
    EXPECT_EQ(map.areas[0].rings[0].holes.size(), 1u);
  }
}

TEST(LandAreas, WhatAnEditorDeletedIsGoneAndTheNewestPlaceOfANodeCounts) {
  const std::string square = R"(
<node id="1" version="1" lon="0" lat="0"/><node id="2" version="1" lon="9" lat="0"/>
<node id="3" version="2" lon="9" lat="8"/><node id="3" version="1" lon="9" lat="9"/>
<way id="1" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/>
  <tag k="natural" v="wood"/></way>)";
  const test::TempFolder folder;
  const auto read = [&](const std::string& more) {
    std::ofstream(folder / "map.osm") << "<osm version=\"0.6\">" << square << more << "</osm>";
    return osm::read_map_areas(folder / "map.osm", select_land(), 1000);
  };
  const osm::MapAreas map = read("");
  ASSERT_EQ(map.areas.size(), 1u);
  EXPECT_EQ(map.areas[0].rings.at(0).outer.at(2), glm::dvec2(9, 8));
  EXPECT_TRUE(read("<way id=\"1\" version=\"2\" visible=\"false\"/>").areas.empty());
  EXPECT_TRUE(read("<way id=\"1\" version=\"1\" action=\"delete\"/>").areas.empty());
  const std::string relation =
      "<member type=\"way\" ref=\"1\" role=\"outer\"/><tag k=\"type\" v=\"multipolygon\"/>"
      "<tag k=\"natural\" v=\"water\"/></relation>";
  EXPECT_EQ(read("<relation id=\"1\" version=\"1\">" + relation).areas.size(), 2u);
  EXPECT_EQ(read("<relation id=\"1\" version=\"1\" action=\"delete\">" + relation).areas.size(),
            1u);
  EXPECT_EQ(read("<relation id=\"1\" version=\"3\" visible=\"false\">" + relation).areas.size(),
            1u);
}

TEST(LandAreas, HostileAreasEndWithoutACrash) {
  const double nan = std::nan("");
  const std::vector<osm::MapArea> areas{
      {"way/1", {{"natural", "water"}}, {{{{nan, nan}, {1, 1}, {2, nan}}, {}}}},
      {"way/2", {{"natural", "water"}}, {{{}, {}}}},
      {"way/3", {{"natural", "wood"}}, {{{{-1e300, 0}, {1e300, 0}, {0, 1e300}}, {}}}},
      {"way/4", {{"natural", "sand"}}, {{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {{{1, 1}}}}}}};
  Cover cover;
  add_land(areas, as_metres, bounds, cover);
  cover.finish();
  cover.find_part({{-5, -5}, {5, 5}}, {0, 0});
  EXPECT_EQ(cover.areas().size(), 1u);
  EXPECT_EQ(cover.left_out.at("area without a finite outline"), 1u);
}

TEST(LandAreas, ASquareThatIsAMultipolygonIsAnAreaAndAWayWithoutNodesIsCounted) {
  const test::TempFolder folder;
  std::ofstream(folder / "map.osm") << R"(<osm version="0.6">
<node id="1" version="1" lon="0" lat="0"/><node id="2" version="1" lon="9" lat="0"/>
<node id="3" version="1" lon="9" lat="9"/><node id="4" version="1" lon="0" lat="9"/>
<way id="1" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/></way>
<way id="2" version="1"><bounds minlat="0" minlon="0" maxlat="1" maxlon="1"/>
  <tag k="landuse" v="grass"/></way>
<relation id="1" version="1"><member type="way" ref="1" role="outer"/>
  <tag k="type" v="multipolygon"/><tag k="highway" v="pedestrian"/></relation></osm>)";
  const osm::MapAreas map = osm::read_map_areas(folder / "map.osm", select_land(), 1000);
  ASSERT_EQ(map.areas.size(), 1u);
  EXPECT_EQ(find_land_use(map.areas[0].tags).value().surface.kind, GroundKind::paving_stones);
  EXPECT_EQ(map.broken, 1u);
}

}  // namespace
}  // namespace nightcity::ground_cover
