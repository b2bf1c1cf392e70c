// Lamps that a map has as relations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/temp_folder.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

using test::TempFolder;
using test::write_text;
using Places = std::vector<std::pair<double, double>>;

std::string tag(const char* key, const char* value) {
  return std::string("<tag k='") + key + "' v='" + value + "'/>";
}

std::string node(int id, double x, double y, const std::string& inside = "") {
  return "<node id='" + std::to_string(id) + "' version='1' lat='" + std::to_string(y) + "' lon='" +
         std::to_string(x) + "'>" + inside + "</node>";
}

std::string way(int id, const std::vector<int>& nodes, const std::string& inside = "") {
  std::string text = "<way id='" + std::to_string(id) + "' version='1'>";
  for (const int n : nodes) text += "<nd ref='" + std::to_string(n) + "'/>";
  return text + inside + "</way>";
}

std::string member(const char* type, int ref, const char* role = "") {
  return std::string("<member type='") + type + "' ref='" + std::to_string(ref) + "' role='" +
         role + "'/>";
}

std::string relation(const std::string& inside, int id = 50, int version = 1) {
  return "<relation id='" + std::to_string(id) + "' version='" + std::to_string(version) + "'>" +
         inside + "</relation>";
}

const std::string lamp = tag("highway", "street_lamp");
const std::string site = tag("type", "site") + lamp, area = tag("type", "multipolygon") + lamp;
const std::string square = node(1, 1, 1) + node(2, 1.2, 1) + node(3, 1.2, 1.4) + node(4, 1, 1.4);

OsmData read(const std::vector<std::string>& texts) {
  const TempFolder folder;
  std::vector<std::filesystem::path> files;
  for (const std::string& text : texts) {
    files.push_back(folder / (std::to_string(files.size()) + ".osm"));
    write_text(files.back(), "<osm version='0.6'>" + text + "</osm>");
  }
  return read_osm(files);
}

// Rounded to 1e-6, from west to east.
Places find_places(const OsmData& map) {
  Places places;
  for (const OsmLampNode& one : map.lamps)
    places.emplace_back(std::round(one.lon_lat.x * 1e6) / 1e6,
                        std::round(one.lon_lat.y * 1e6) / 1e6);
  std::sort(places.begin(), places.end());
  return places;
}

TEST(LampRelations, AMultipolygonIsALampInItsMiddle) {
  const std::string outline = square + way(10, {1, 2, 3}) + way(11, {3, 4, 1});
  const OsmData map =
      read({outline + relation(member("way", 10, "outer") + member("way", 11, "outer") + area +
                               tag("lamp_type", "led"))});
  EXPECT_EQ(find_places(map), (Places{{1.1, 1.2}}));
  ASSERT_EQ(map.lamps.size(), 1u);
  EXPECT_EQ(map.lamps[0].tags.at("lamp_type"), "led");
  EXPECT_EQ(map.lamps[0].tags.count("type"), 0u);
  EXPECT_TRUE(map.lamps[0].is_way);
  EXPECT_EQ(map.lamp_relations, 0u);
  EXPECT_EQ(map.nodes, 4u) << "read twice, and counted once";
  EXPECT_EQ(map.ways, 2u);
  EXPECT_EQ(map.relations, 1u);
}

TEST(LampRelations, EachRingOfAMultipolygonIsALampAndHolesAreNone) {
  const std::string rings = square + node(5, 2, 2) + node(6, 2.2, 2) + node(7, 2.2, 2.2) +
                            way(10, {1, 2, 3, 4, 1}, tag("highway", "footway")) +
                            way(11, {5, 6, 7, 5}) + way(12, {1, 2, 3, 1});
  EXPECT_EQ(
      find_places(read({rings + relation(member("way", 10, "outer") + member("way", 11, "outer") +
                                         member("way", 12, "inner") + area)})),
      (Places{{1.1, 1.2}, {2.133333, 2.066667}}));
}

TEST(LampRelations, AnOuterWayThatIsTheLampStandsForTheRelation) {
  const OsmData map =
      read({square + way(10, {1, 2, 3, 4, 1}, lamp) +
            relation(member("way", 10, "outer") + area + tag("light:colour", "white"))});
  EXPECT_EQ(find_places(map), (Places{{1.1, 1.2}}));
  EXPECT_EQ(map.lamps.at(0).tags.at("light:colour"), "white");
}

TEST(LampRelations, EachMemberOfASiteIsALamp) {
  // A node, a post, a lamp that has tags of its own, a line, and what is none.
  const std::string members =
      square + node(5, 3, 1, tag("power", "pole")) + node(6, 4, 1, lamp + tag("lamp_type", "gas")) +
      node(7, 5, 1, tag("man_made", "street_cabinet")) + node(8, 6, 1) + way(10, {2, 3});
  const OsmData map = read(
      {members + relation(member("node", 1) + member("node", 5) + member("node", 6) +
                          member("node", 7) + member("node", 8, "perimeter") + member("way", 10) +
                          member("relation", 51) + site + tag("lamp_type", "led"))});
  EXPECT_EQ(find_places(map), (Places{{1, 1}, {1.2, 1.2}, {3, 1}, {4, 1}}));
  for (const OsmLampNode& one : map.lamps)
    EXPECT_EQ(one.tags.at("lamp_type"), one.id == 6 ? "gas" : "led") << one.id;
}

TEST(LampRelations, AMemberOfTwoRelationsIsOneLamp) {
  EXPECT_EQ(find_places(read({square + relation(member("node", 1) + member("node", 2) + site) +
                              relation(member("node", 2) + member("node", 3) + site, 51)})),
            (Places{{1, 1}, {1.2, 1}, {1.2, 1.4}}));
}

TEST(LampRelations, TheNewestVersionCounts) {
  const std::string one = relation(member("node", 1) + site, 50, 1),
                    none = relation(member("node", 1) + tag("type", "site"), 50, 2),
                    other = relation(member("node", 2) + site, 50, 3),
                    gone = "<relation id='50' version='4' visible='false'/>";
  EXPECT_EQ(find_places(read({square + one})).size(), 1u);
  EXPECT_EQ(find_places(read({square + none + one})).size(), 0u);
  EXPECT_EQ(find_places(read({square + one, square + other})), (Places{{1.2, 1}}));
  EXPECT_EQ(find_places(read({square + other + gone})).size(), 0u);
  EXPECT_EQ(find_places(read({square + one, square + one})).size(), 1u);
}

TEST(LampRelations, OfEditorsIdsBelongToTheirFile) {
  const auto editor = [](double x) {
    return "<node id='-1' lat='1' lon='" + std::to_string(x) + "'/>" +
           relation(member("node", -1) + site, -5);
  };
  EXPECT_EQ(find_places(read({editor(1), editor(2)})), (Places{{1, 1}, {2, 1}}));
}

TEST(LampRelations, MembersMayLieInAnotherFileOrInTheRelation) {
  EXPECT_EQ(find_places(read({relation(member("node", 1) + site), square})), (Places{{1, 1}}));
  EXPECT_EQ(find_places(read({relation("<member type='node' ref='1' lat='7' lon='8'/>" + site)})),
            (Places{{8, 7}}));
  EXPECT_EQ(find_places(read({relation("<member type='way' ref='1' role='outer'>"
                                       "<nd lat='1' lon='1'/><nd lat='1' lon='2'/>"
                                       "<nd lat='2' lon='2'/><nd lat='2' lon='1'/>"
                                       "<nd lat='1' lon='1'/></member>" +
                                       area)})),
            (Places{{1.5, 1.5}}));
  EXPECT_EQ(find_places(read({relation("<center lat='3' lon='4'/>" + area)})), (Places{{4, 3}}));
}

TEST(LampRelations, WithoutAPlaceTheyAreCounted) {
  const OsmData map = read({square + relation(member("node", 9) + site) +
                            relation(member("way", 9, "outer") + area, 51) + relation(site, 52) +
                            relation(member("node", 1) + site, 53)});
  EXPECT_EQ(map.lamps.size(), 1u);
  EXPECT_EQ(map.lamp_relations, 3u);
}

}  // namespace
}  // namespace nightcity::osm
