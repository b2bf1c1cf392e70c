#include "tools/barriers/outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#include "support/temp_folder.h"
#include "tools/osm/read_osm.h"

namespace nightcity::barriers {
namespace {

using test::TempFolder;

// A square from 0.0000 to 0.0003 degrees with a hole, of ways without tags; a gate on its ring.
std::filesystem::path write_map(const std::filesystem::path& folder, const std::string& tags) {
  std::ofstream(folder / "map.osm") << R"(<osm version='0.6'>
    <node id='1' lon='0.0000001' lat='0'><tag k='barrier' v='gate'/></node>
    <node id='2' lon='0.0003' lat='0'/><node id='3' lon='0.0003' lat='0.0003'/>
    <node id='4' lon='0' lat='0.0003'/>
    <node id='5' lon='0.0001' lat='0.0001'/><node id='6' lon='0.0002' lat='0.0001'/>
    <node id='7' lon='0.0002' lat='0.0002'/>
    <way id='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/></way>
    <way id='2'><nd ref='3'/><nd ref='4'/><nd ref='1'/></way>
    <way id='3'><nd ref='5'/><nd ref='6'/><nd ref='7'/><nd ref='5'/></way>
    <way id='4'><nd ref='5'/><nd ref='6'/><nd ref='7'/><nd ref='5'/><tag k='barrier' v='wall'/></way>
    <relation id='1'><member type='way' ref='1' role='outer'/>
      <member type='way' ref='2' role='outer'/><member type='way' ref='3' role='inner'/>
      <tag k='type' v='multipolygon'/>)"
                                    << tags << "</relation></osm>";
  return folder / "map.osm";
}

TEST(BarrierOutlines, EachRingOfAMultipolygonIsAClosedWay) {
  const TempFolder folder;
  const auto map = write_map(folder.path(), "<tag k='barrier' v='hedge'/><tag k='height' v='2'/>");
  std::set<std::string> known;
  const auto ways = read_outlines(map, 1000, known);
  ASSERT_EQ(ways.size(), 2u) << "an outer ring and a hole; a closed way is no multipolygon";
  EXPECT_EQ(ways[0].lon_lat.size(), 5u);
  EXPECT_EQ(ways[1].lon_lat.size(), 4u);
  for (const osm::OsmWay& way : ways) {
    EXPECT_EQ(way.lon_lat.front(), way.lon_lat.back());
    EXPECT_EQ(way.tags.at("barrier"), "hedge");
    EXPECT_EQ(way.tags.at("height"), "2");
  }
  EXPECT_TRUE(read_outlines(map, 1000, known).empty()) << "another map had it";
}

TEST(BarrierOutlines, GatesLieOnThemToTheLastBit) {
  const TempFolder folder;
  const auto map = write_map(folder.path(), "<tag k='barrier' v='fence'/>");
  std::set<std::string> known;
  const auto ways = read_outlines(map, 1000, known);
  const osm::OsmData data = osm::read_osm(map);
  ASSERT_EQ(data.gates.size(), 1u);
  EXPECT_EQ(data.barrier_relations, 1u);
  const auto& ring = ways.at(0).lon_lat;
  EXPECT_NE(std::find(ring.begin(), ring.end(), data.gates[0].lon_lat), ring.end());
}

TEST(BarrierOutlines, OtherMultipolygonsAndThoseOfTooManyNodesHaveNone) {
  const TempFolder folder;
  std::set<std::string> known;
  const auto other = write_map(folder.path(), "<tag k='landuse' v='grass'/>");
  EXPECT_TRUE(read_outlines(other, 1000, known).empty());
  EXPECT_EQ(osm::read_osm(other).barrier_relations, 0u);
  const auto fence = write_map(folder.path(), "<tag k='barrier' v='fence'/>");
  EXPECT_TRUE(read_outlines(fence, 5, known).empty());
}

}  // namespace
}  // namespace nightcity::barriers
