#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "formats/error.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/read_osm.h"
#include "tools/osm/resolution.h"

namespace nightcity::osm {
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

TEST_F(OsmFile, AWayOfTooManyNodesIsLeftOutAndCounted) {
  std::string refs;
  for (int i = 0; i < 100; ++i) refs += "<nd ref='" + std::to_string(1 + i % 2) + "'/>";
  const auto file =
      write("<osm><node id='1' lat='1' lon='1'/><node id='2' lat='2' lon='2'/><way id='1'>" + refs +
            "<tag k='highway' v='residential'/></way><way id='2'>" + refs + "</way></osm>");
  EXPECT_EQ(read_osm(file, 100).highways.size(), 1u);
  EXPECT_EQ(read_osm(file, 100).long_ways, 0u);
  EXPECT_EQ(read_osm(file, 99).highways.size(), 0u);
  EXPECT_EQ(read_osm(file, 99).long_ways, 1u) << "one that nothing uses does not count";
}

TEST_F(OsmFile, WhatIsNotThereTodayIsLeftOutAndCounted) {
  const auto street = [&](const std::string& key, const std::string& value) {
    const OsmData data = read(
        "<node id='1' lat='1' lon='1'/><node id='2' lat='2' lon='2'/><node id='3' lat='1' "
        "lon='1'><tag k='natural' v='tree'/><tag k='" +
        key + "' v='" + value +
        "'/></node><way id='1'><nd ref='1'/><nd ref='2'/><tag k='highway' "
        "v='residential'/><tag k='" +
        key + "' v='" + value + "'/></way>");
    EXPECT_EQ(data.gone, 2 - data.highways.size() - data.trees.size()) << key;
    EXPECT_EQ(data.highways.size(), data.trees.size()) << key;
    return data.highways.size() == 1;
  };
  EXPECT_FALSE(street("end_date", "2015"));
  EXPECT_FALSE(street("demolished", "2015-06"));
  EXPECT_FALSE(street("removed", "yes"));
  EXPECT_FALSE(street("start_date", "9998"));
  EXPECT_FALSE(street("opening_date", "9998-05-01"));
  EXPECT_TRUE(street("end_date", "9998"));
  EXPECT_TRUE(street("end_date", "soon"));
  EXPECT_TRUE(street("start_date", "C19"));
  EXPECT_TRUE(street("demolished", "no"));
  EXPECT_TRUE(street("disused", "yes")) << "it is there, and nobody uses it";
}

// Imports and slips leave things twice in one place. Such a street was lit as two, a pitch had the
// light of two.
TEST_F(OsmFile, WhatAMapHasTwiceInOnePlaceIsReadOnce) {
  const std::string nodes =
      "<node id='1' lat='1' lon='1'/><node id='2' lat='1.1' lon='1'/><node id='3' lat='1.1' "
      "lon='1.1'/>"
      "<node id='11' lat='1' lon='1'/><node id='12' lat='1.1' lon='1'/><node id='13' lat='1.1' "
      "lon='1.1'/>";
  int next = 20;
  const auto way = [&](const std::string& refs, const std::string& tags) {
    std::string text = "<way id='" + std::to_string(next++) + "'>";
    for (std::size_t at = 0; at < refs.size(); at = refs.find(' ', at) + 1) {
      const std::size_t end = std::min(refs.find(' ', at), refs.size());
      text += "<nd ref='" + refs.substr(at, end - at) + "'/>";
      if (end == refs.size()) break;
    }
    return text + tags + "</way>";
  };
  const auto tag = [](const char* key, const char* value) {
    return "<tag k='" + std::string(key) + "' v='" + value + "'/>";
  };
  const std::string street = tag("highway", "residential"),
                    pitch = tag("leisure", "pitch") + tag("lit", "yes");
  const OsmData once = read(nodes + way("1 2 3", street) +
                            way("11 12 13", street + tag("name", "A")) + way("3 2 1", street));
  ASSERT_EQ(once.highways.size(), 1u) << "the nodes, other nodes in their places, backwards";
  EXPECT_EQ(once.highways[0].tags.size(), 2u) << "the one that says more";
  EXPECT_EQ(once.repeated, 2u);
  const OsmData rings =
      read(nodes + way("1 2 3 1", pitch) + way("12 13 11 12", pitch) + way("3 2 1 3", pitch));
  EXPECT_EQ(rings.shining_things.size(), 1u) << "rings begin anywhere";
  const OsmData others = read(
      nodes + way("1 2 3", street) + way("1 2", street) + way("1 2 3", tag("highway", "footway")) +
      way("1 2 3", street + tag("layer", "1")) + way("1 2 3", tag("railway", "tram")) +
      way("1 2 3", tag("barrier", "wall")) + way("1 2 3", tag("barrier", "hedge")));
  EXPECT_EQ(others.highways.size(), 4u);
  EXPECT_EQ(others.railways.size(), 1u);
  EXPECT_EQ(others.barriers.size(), 2u);
  EXPECT_EQ(others.repeated, 0u);
  const std::string tree = "' lat='1' lon='1'>" + tag("natural", "tree");
  const OsmData trees =
      read("<node id='1" + tree + "</node><node id='2" + tree + tag("height", "9") + "</node>");
  ASSERT_EQ(trees.trees.size(), 1u);
  EXPECT_EQ(trees.trees[0].tags.at("height"), "9");
}

TEST_F(OsmFile, LampsOfRelationsWithoutMembersAndLinesOfRoofsAreCounted) {
  const OsmData data = read(
      "<node id='1' lat='1' lon='1'/><node id='2' lat='1.1' lon='1'/>"
      "<way id='3'><nd ref='1'/><nd ref='2'/><tag k='roof:ridge' v='yes'/></way>"
      "<way id='4'><nd ref='1'/><nd ref='2'/><tag k='roof:edge' v='yes'/></way>"
      "<relation id='5'><member type='node' ref='9' role=''/><tag k='highway' v='street_lamp'/>"
      "</relation>");
  EXPECT_EQ(data.roof_lines, 2u);
  EXPECT_EQ(data.lamp_relations, 1u);
  EXPECT_EQ(count_skipped(data).at("ridges and edges of roofs"), 2u);
}

TEST_F(OsmFile, ThingsThatMayShineComeByIdWithNodesFirst) {
  const OsmData data = read(R"(
    <node id="9" lat="52.5" lon="13.4"><tag k="advertising" v="column"/></node>
    <node id="3" lat="52.5" lon="13.5"><tag k="historic" v="memorial"/><tag k="lit" v="yes"/></node>
    <node id="4" lat="52.6" lon="13.5"><tag k="historic" v="memorial"/></node>
    <node id="5" lat="52.6" lon="13.6"><tag k="advertising" v="no"/></node>
    <way id="1"><nd ref="9"/><nd ref="3"/><nd ref="4"/><nd ref="9"/>
      <tag k="building" v="church"/><tag k="floodlit" v="yes"/></way>
    <way id="2"><nd ref="9"/><nd ref="3"/><tag k="highway" v="footway"/><tag k="lit" v="yes"/>
      <tag k="historic" v="roman_road"/></way>)");
  ASSERT_EQ(data.shining_things.size(), 3u);
  EXPECT_EQ(data.shining_things[0].id, 3);
  EXPECT_EQ(data.shining_things[1].id, 9);
  EXPECT_TRUE(data.shining_things[2].is_way);
  EXPECT_EQ(data.shining_things[2].lon_lat.size(), 4u);
  EXPECT_EQ(data.buildings.size(), 1u) << "a floodlit church is a building as before";
  EXPECT_EQ(data.highways.size(), 1u);
}

TEST_F(OsmFile, BarriersComeWithTheirGatesAtTheVeryPlacesOfTheirNodes) {
  const OsmData data = read(R"(
    <node id="1" lat="52.5" lon="13.4"/><node id="2" lat="52.512345678" lon="13.498765432">
      <tag k="barrier" v="gate"/></node><node id="3" lat="52.7" lon="13.6"/>
    <way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="barrier" v="wall"/></way>
    <way id="2"><nd ref="1"/><nd ref="2"/><tag k="barrier" v="no"/></way>
    <way id="3"><nd ref="1"/><nd ref="3"/><tag k="barrier" v="kerb"/><tag k="highway" v="footway"/>
      </way>
    <way id="4"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="barrier" v="wall"/>
      <tag k="building" v="yes"/></way>
    <way id="5"><nd ref="1"/><nd ref="3"/><tag k="barrier" v="fence"/><tag k="leisure" v="pitch"/>
      </way>)");
  ASSERT_EQ(data.barriers.size(), 2u) << "streets and buildings stay what they are";
  EXPECT_EQ(data.barriers[0].id, 1);
  EXPECT_EQ(data.barriers[1].id, 5);
  ASSERT_EQ(data.gates.size(), 1u);
  EXPECT_EQ(data.gates[0].lon_lat, data.barriers[0].lon_lat[1]);
  EXPECT_EQ(data.highways.size(), 1u);
  EXPECT_EQ(data.buildings.size(), 1u);
}

TEST_F(OsmFile, SignsAndSignalsOfStreetsComeWithTheirTags) {
  const OsmData data = read(R"(
    <node id="1" lat="52.5" lon="13.4"><tag k="highway" v="stop"/></node>
    <node id="2" lat="52.6" lon="13.4"><tag k="highway" v="crossing;traffic_signals"/></node>
    <node id="3" lat="52.7" lon="13.4"><tag k="highway" v="give_way"/>
      <tag k="direction" v="backward"/></node>
    <node id="4" lat="52.7" lon="13.5"><tag k="highway" v="crossing"/></node>)");
  ASSERT_EQ(data.controls.size(), 3u);
  EXPECT_EQ(data.controls[2].tags.at("direction"), "backward");
  EXPECT_EQ(data.crossings.size(), 2u);
  EXPECT_TRUE(data.lamps.empty());
}

TEST_F(OsmFile, RailwaysComeBesideStreetsAlsoWhereOneWayIsBoth) {
  const OsmData data = read(R"(
    <node id="1" lat="52.5" lon="13.4"/><node id="2" lat="52.6" lon="13.4"/>
    <node id="3" lat="52.7" lon="13.4"/>
    <way id="1"><nd ref="1"/><nd ref="2"/><tag k="railway" v="tram"/></way>
    <way id="2"><nd ref="2"/><nd ref="3"/><tag k="railway" v="tram"/>
      <tag k="highway" v="residential"/></way>
    <way id="3"><nd ref="1"/><nd ref="2"/><tag k="railway" v="no"/></way>)");
  ASSERT_EQ(data.railways.size(), 2u);
  EXPECT_EQ(data.railways[1].id, 2);
  EXPECT_EQ(data.railways[1].lon_lat.size(), 2u);
  EXPECT_EQ(data.highways.size(), 1u);
}

TEST_F(OsmFile, AStreetWithoutNodesIsCounted) {
  const OsmData data = read(R"(
    <way id="1"><bounds minlat="52.5" minlon="13.4" maxlat="52.6" maxlon="13.5"/>
      <tag k="highway" v="residential"/></way>)");
  EXPECT_TRUE(data.highways.empty());
  EXPECT_EQ(data.missing_nodes, 1u);
}

TEST_F(OsmFile, WatercoursesAndCoastsAreLines) {
  const OsmData data = read(R"(
    <node id="1" lat="52.5" lon="13.4"/><node id="2" lat="52.6" lon="13.4"/>
    <way id="1"><nd ref="1"/><nd ref="2"/><tag k="waterway" v="stream"/></way>
    <way id="2"><nd ref="1"/><nd ref="2"/><tag k="natural" v="coastline"/></way>
    <way id="3"><nd ref="1"/><nd ref="2"/><tag k="waterway" v="dam"/></way>)");
  ASSERT_EQ(data.watercourses.size(), 2u);
  EXPECT_EQ(data.watercourses[1].id, 2);
}

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

TEST_F(OsmFile, AnElementOfSeveralFilesComesOnce) {
  const std::string lamp =
      R"(<node id="1" lat="1" lon="1"><tag k="highway" v="street_lamp"/></node>)";
  const std::string other =
      R"(<node id="2" lat="1" lon="1"><tag k="highway" v="street_lamp"/></node>)";
  const OsmData data = read_osm(std::array{write("<osm>" + lamp + "</osm>", "a.osm"),
                                           write("<osm>" + lamp + other + "</osm>", "b.osm")});
  EXPECT_EQ(data.lamps.size(), 2u);
  EXPECT_EQ(data.duplicates, 1u);
  EXPECT_EQ(data.nodes, 3u);
}

const std::string lamp_tag = R"(<tag k="highway" v="street_lamp"/>)";

TEST_F(OsmFile, TheNewestVersionCountsWhateverTheOrder) {
  const std::string old = R"(<node id="1" version="1" lat="1" lon="1">)" + lamp_tag + "</node>",
                    now = R"(<node id="1" version="2" lat="2" lon="2">)" + lamp_tag + "</node>",
                    edited = R"(<node id="1" version="2" action="modify" lat="3" lon="3">)" +
                             lamp_tag + "</node>";
  for (const std::string& text : {old + now, now + old}) {
    const OsmData data = read(text);
    ASSERT_EQ(data.lamps.size(), 1u);
    EXPECT_EQ(data.lamps[0].lon_lat.x, 2);
    EXPECT_EQ(data.old_versions, 1u);
    EXPECT_EQ(data.duplicates, 0u);
  }
  EXPECT_EQ(read(now + edited + old).lamps.at(0).lon_lat.x, 3);
  const auto a = write("<osm>" + old + "</osm>", "a.osm"),
             b = write("<osm>" + now + "</osm>", "b.osm");
  EXPECT_EQ(read_osm(std::array{a, b}).lamps.at(0).lon_lat.x, 2);
  EXPECT_EQ(read_osm(std::array{b, a}).lamps.at(0).lon_lat.x, 2);
}

TEST_F(OsmFile, WhatIsDeletedOrNoLongerALampIsGone) {
  const std::string lamp = R"(<node id="1" version="3" lat="1" lon="1">)" + lamp_tag + "</node>";
  for (const std::string gone : {R"(<node id="1" version="4" visible="false"/>)",
                                 R"(<node id="1" version="4" lat="1" lon="1"/>)",
                                 R"(<node id="1" version="3" action="delete" lat="1" lon="1"/>)"}) {
    EXPECT_EQ(read(lamp + gone).lamps.size(), 0u) << gone;
    EXPECT_EQ(read(gone + lamp).lamps.size(), 0u) << gone;
    const auto a = write("<osm>" + lamp + "</osm>", "a.osm"),
               b = write("<osm>" + gone + "</osm>", "b.osm");
    EXPECT_EQ(read_osm(std::array{a, b}).lamps.size(), 0u) << gone;
    EXPECT_EQ(read_osm(std::array{b, a}).lamps.size(), 0u) << gone;
  }
  // An undeleted lamp is there again.
  EXPECT_EQ(read(R"(<node id="1" version="2" visible="false"/>)" + lamp).lamps.size(), 1u);
  const std::string nodes = R"(<node id="2" lat="1" lon="1"/><node id="3" lat="2" lon="2"/>)";
  EXPECT_EQ(read(nodes + R"(
    <way id="9" version="1"><nd ref="2"/><nd ref="3"/><tag k="highway" v="primary"/></way>
    <way id="9" version="2" visible="false"/>)")
                .highways.size(),
            0u);
}

TEST_F(OsmFile, EditorsIdsAreTheSameInOneFileOnly) {
  const auto text = [](const char* lon) {
    return std::string("<osm><node id='-1' lat='1' lon='") + lon +
           "'/><node id='-2' lat='2' lon='2'/><way id='-9'><nd ref='-1'/><nd ref='-2'/>"
           "<tag k='highway' v='primary'/></way></osm>";
  };
  const OsmData data = read_osm(std::array{write(text("1"), "a.osm"), write(text("5"), "b.osm")});
  ASSERT_EQ(data.highways.size(), 2u);
  EXPECT_NEAR(data.highways[0].lon_lat[0].x, 1, 1e-9);
  EXPECT_NEAR(data.highways[1].lon_lat[0].x, 5, 1e-9);
}

TEST_F(OsmFile, WaysMayHoldTheirPlacesThemselves) {
  const OsmData data = read(R"(
    <way id="10"><nd ref="2" lat="48.995" lon="9.001"/><nd ref="3" lat="48.996" lon="9.003"/>
    <tag k="highway" v="residential"/></way>)");
  ASSERT_EQ(data.highways.size(), 1u);
  EXPECT_EQ(data.missing_nodes, 0u);
  EXPECT_EQ(data.highways[0].lon_lat.at(1),
            glm::dvec2(round_degrees(9.003), round_degrees(48.996)));
}

TEST_F(OsmFile, PlacesOnWaysAreThoseOfTheirNodesToTheLastBit) {
  // 13.4000001 is no multiple of 1e-7 in doubles.
  const std::string place = " lat='52.5123457' lon='13.4000001'",
                    tag = "<tag k='highway' v='road'/>";
  const OsmData of_nodes = read("<node id='1'" + place +
                                "/><node id='2' lat='1' lon='1'/><way id='9'>"
                                "<nd ref='1'/><nd ref='2'/>" +
                                tag + "</way>"),
                of_ways = read("<way id='9'><nd ref='1'" + place +
                               "/><nd ref='2' lat='1' lon='1'/>" + tag + "</way>");
  ASSERT_EQ(of_nodes.highways.size(), 1u);
  ASSERT_EQ(of_ways.highways.size(), 1u);
  EXPECT_EQ(of_ways.highways[0].lon_lat, of_nodes.highways[0].lon_lat);
}

TEST_F(OsmFile, TheOrderInWhichAMapIsWrittenDoesNotMatter) {
  std::vector<std::string> elements;
  for (const char* const id : {"1", "2", "3"}) {
    const std::string n = id;
    elements.push_back("<node id='" + n + "' lat='" + n + "' lon='1'>" + lamp_tag + "</node>");
    elements.push_back("<node id='2" + n + "' lat='" + n +
                       "' lon='1'><tag k='natural' v='tree'/></node>");
    elements.push_back("<way id='" + n +
                       "'><nd ref='1'/><nd ref='2'/><nd ref='3'/>"
                       "<tag k='highway' v='road'/></way>");
  }
  const auto tell = [&] {
    std::string all, said;
    for (const std::string& element : elements) all += element;
    const OsmData data = read(all);
    for (const OsmLampNode& lamp : data.lamps) said += " lamp " + std::to_string(lamp.id);
    for (const OsmPoint& tree : data.trees) said += " tree " + std::to_string(tree.lon_lat.y);
    for (const OsmWay& way : data.highways) said += " way " + std::to_string(way.id);
    return said;
  };
  const std::string sorted = tell();
  EXPECT_NE(sorted.find("lamp 1 lamp 2 lamp 3"), std::string::npos) << sorted;
  std::reverse(elements.begin(), elements.end());
  EXPECT_EQ(tell(), sorted);
}

TEST_F(OsmFile, ANodeThatIsNamedTwiceInARowIsOneCorner) {
  const std::string nodes =
      "<node id='1' lat='1' lon='1'/><node id='2' lat='2' lon='2'/>"
      "<node id='3' lat='2' lon='2'/>";
  const OsmData data = read(nodes +
                            "<way id='9'><nd ref='1'/><nd ref='1'/><nd ref='2'/><nd ref='3'/>"
                            "<nd ref='1'/><tag k='highway' v='road'/></way><way id='8'>"
                            "<nd ref='1'/><nd ref='1'/><tag k='highway' v='road'/></way>");
  ASSERT_EQ(data.highways.size(), 1u) << "a way of one place has no length";
  EXPECT_EQ(data.highways[0].lon_lat, (std::vector<glm::dvec2>{{1, 1}, {2, 2}, {1, 1}}));
}

TEST_F(OsmFile, LampsMayBeLinesOrAreas) {
  const OsmData data = read(R"(
    <node id="1" lat="1" lon="1"/><node id="2" lat="1" lon="3"/><node id="3" lat="3" lon="3"/>
    <node id="4" lat="3" lon="1"/>
    <way id="5"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/>
    <tag k="man_made" v="mast"/><tag k="tower:type" v="lighting"/></way>
    <way id="6"><nd ref="7"/><center lat="5" lon="6"/><tag k="highway" v="street_lamp"/></way>)");
  ASSERT_EQ(data.lamps.size(), 2u);
  EXPECT_NEAR(data.lamps[0].lon_lat.x, 2, 1e-9);
  EXPECT_NEAR(data.lamps[0].lon_lat.y, 2, 1e-9);
  EXPECT_TRUE(data.lamps[0].is_way);
  EXPECT_EQ(data.lamps[1].lon_lat, glm::dvec2(6, 5));
  EXPECT_TRUE(data.highways.empty());
}

TEST_F(OsmFile, AnAnswerThatTheServerCallsIncompleteIsRefused) {
  EXPECT_NE(error_of(write("<osm>\n<remark> runtime error: Query timed out </remark></osm>"))
                .find(":2: the server's answer is incomplete"),
            std::string::npos);
  EXPECT_EQ(read("<remark>made on a Tuesday</remark>").remarks.size(), 1u);
}

TEST_F(OsmFile, RemarksInPackedFilesAreReadToo) {
  const auto pack = [&](const std::string& text, const char* packer, const char* ending) {
    const auto path = write(text, "answer.osm");
    const auto packed = path.string() + ending;
    std::filesystem::remove(packed);
    if (std::system((std::string(packer) + " -k " + path.string()).c_str()) != 0)
      return std::string();
    return packed;
  };
  const std::string root = "<osm version=\"0.6\" generator=\"Overpass API 0.7\">\n";
  const std::string filler(300'000, ' ');
  for (const auto& [packer, ending] : {std::pair{"gzip", ".gz"}, std::pair{"bzip2", ".bz2"}}) {
    const std::string bad = pack(
        root + filler + "<remark> runtime error: Query timed out </remark></osm>", packer, ending);
    if (bad.empty()) GTEST_SKIP() << packer << " is absent";
    EXPECT_NE(error_of(bad).find(": the server's answer is incomplete"), std::string::npos);
    const OsmData data =
        read_osm(pack(root + "<remark>made on a Tuesday</remark></osm>", packer, ending));
    EXPECT_EQ(data.remarks, std::vector<std::string>{"made on a Tuesday"});
  }
}

TEST_F(OsmFile, APackedAnswerOfOverpassMayHoldPlacesInRelations) {
  const auto path = write(
      "<osm version=\"0.6\" generator=\"Overpass API\"><relation id=\"1\"><member type=\"way\" "
      "ref=\"1\" role=\"outer\"><nd lat=\"1\" lon=\"2\"/></member></relation><node id=\"1\" "
      "lat=\"48\" "
      "lon=\"9\"><tag k=\"highway\" v=\"street_lamp\"/></node></osm>",
      "answer.osm");
  std::filesystem::remove(path.string() + ".gz");
  if (std::system(("gzip -k " + path.string()).c_str()) != 0) GTEST_SKIP() << "gzip is absent";
  EXPECT_EQ(read_osm(std::filesystem::path(path.string() + ".gz")).lamps.size(), 1u);
}

TEST_F(OsmFile, WhatIsNoExtractIsNamed) {
  using namespace std::string_literals;
  const struct {
    std::string content;
    const char* said;
  } files[] = {
      {"\xfd"
       "7zXZ\0 rest"s,
       "broken xz stream"},
      {"\x28\xb5\x2f\xfd rest", "broken zstd stream"},
      {"\x04\x22\x4d\x18 rest", "broken lz4 stream"},
      {"n2 v0 dV c0 t i0 u T x9.001 y48.995\n", "OPL"},
      {"\xff\xe0\x04o5c2", "change file"},
      {"<?xml version='1.0'?><osmChange version='0.6'/>", "apply-changes"},
      {"<!DOCTYPE html><html></html>", "web page"},
      {R"({"version": 0.6, "generator": "Overpass API", "osm3s": {})", "no whole JSON"},
      {"@id\t@lat\t@lon\n", "CSV"},
      {"<osm version='0.6'><action type='create'><node id='1' lat='1' lon='2'/></action></osm>",
       "augmented diff"},
  };
  for (const auto& [content, said] : files)
    EXPECT_NE(error_of(write(content)).find(said), std::string::npos) << said;
}

TEST_F(OsmFile, XmlMayBeUtf16) {
  const std::string text =
      "<?xml version='1.0' encoding='UTF-16'?><osm version='0.6'><node id='1' lat='48' lon='9'>"
      "<tag k='highway' v='street_lamp'/></node></osm>";
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += {c, '\0'};
  EXPECT_EQ(read_osm(write(wide)).lamps.size(), 1u);
}

TEST_F(OsmFile, EveryUnusableFileIsAnErrorThatNamesIt) {
  EXPECT_NE(error_of(folder_ / "absent.osm").find("absent.osm: no such file"), std::string::npos);
  EXPECT_NE(error_of(folder_).find("not a file"), std::string::npos);
  EXPECT_NE(error_of(write("")).find("empty"), std::string::npos);
  EXPECT_NE(error_of(write("hello")).find("not OSM data"), std::string::npos);
  EXPECT_NE(error_of(write("<gpx></gpx>")).find("<osm>"), std::string::npos);
  EXPECT_NE(error_of(write("<osm>\n<node id='1'\n")).find(":2: "), std::string::npos);
  EXPECT_NE(error_of(write("<osm><node></osm>")).find(":1: "), std::string::npos);
  EXPECT_NE(error_of(write("<!DOCTYPE osm [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><osm/>"))
                .find("DOCTYPE"),
            std::string::npos);
  EXPECT_NE(error_of(write("<osm><node id='1' lat='0' lon='0'/></osm>\n<osm/>"))
                .find("several documents"),
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
                            {{"highway", "street_lamp;advertising_column"}},
                            {{"light_source", "aviation; floodlight"}},
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

// The rectangle goes round all of several maps, where each says its own.
TEST(OsmBounds, AreThoseRoundAllMapsThatSayTheirs) {
  const test::TempFolder folder;
  const auto write = [&](const char* name, const std::string& bounds) {
    std::ofstream(folder / name) << "<osm version=\"0.6\">" << bounds
                                 << "<node id=\"1\" version=\"1\" lat=\"1\" lon=\"2\"/></osm>";
    return folder / name;
  };
  const std::filesystem::path
      west = write("west.osm", R"(<bounds minlat="1" minlon="2" maxlat="3" maxlon="4"/>)"),
      east = write("east.osm", R"(<bounds minlat="0" minlon="4" maxlat="2" maxlon="6.5"/>
                                  <bounds minlat="2" minlon="4" maxlat="2.5" maxlon="5"/>)"),
      none = write("none.osm", R"(<bounds minlat="x" minlon="4" maxlat="2" maxlon="6"/>)");
  const auto both = read_osm(std::vector{west, east}).bounds;
  ASSERT_TRUE(both);
  EXPECT_EQ(both->low, glm::dvec2(2, 0));
  EXPECT_EQ(both->high, glm::dvec2(6.5, 3));
  EXPECT_FALSE(read_osm(none).bounds);
  if (std::system(("gzip -k " + west.string()).c_str()) == 0) {
    const auto packed = read_osm(folder / "west.osm.gz").bounds;
    ASSERT_TRUE(packed);
    EXPECT_EQ(packed->low, glm::dvec2(2, 1));
    EXPECT_EQ(packed->high, glm::dvec2(4, 3));
  }
  EXPECT_FALSE(read_osm(std::vector{west, none}).bounds);
}

}  // namespace
}  // namespace nightcity::osm
