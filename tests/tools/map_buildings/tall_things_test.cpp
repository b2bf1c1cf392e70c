// Chimneys, tanks and towers of a map that no tag calls buildings.
#include "tools/map_buildings/tall_things.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/map_buildings/metre_map.h"

namespace nightcity::map_buildings {
namespace {

using namespace test;
using Reasons = std::map<std::string, std::size_t>;

constexpr const char* twice = "chimney, tower or tank that the map has as a building, or twice";

TEST(TallThings, AreasStandAsHighAsTheySay) {
  const struct {
    const char* tags;
    double volume;  // on 10 m x 6 m
  } cases[] = {{"man_made=chimney,height=80", 60 * 80},
               {"man_made=silo,height=50 ft", 60 * 50 * 0.3048},
               {"man_made=gasometer,est_height=30", 60 * 30},
               {"man_made=water_tower,height=30,min_height=20", 60 * 10},
               {"man_made=storage_tank,height=12,roof:shape=pyramidal,roof:height=3", 60 * (9 + 1)},
               {"man_made=cooling_tower,height=100 m", 60 * 100},
               {"man_made=communications_tower,height=120", 60 * 120},
               {"man_made=tower,building:levels=5,tower:type=observation", 60 * 15},
               {"man_made=tower,height=40,tower:construction=freestanding", 60 * 40},
               {"man_made=Water Tower,height=25", 60 * 25},
               {"man_made=lighthouse,height=20", 60 * 20},
               {"man_made=obelisk,height=23", 60 * 23},
               {"man_made=storage_tank", 60 * 6}};
  for (const auto& [tags, expected] : cases) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, tags);
    const Read result = read(map);
    ASSERT_EQ(result.objects.size(), 1u) << tags;
    expect_near(volume(result.objects[0]), expected);
    EXPECT_TRUE(result.report.skipped.empty()) << tags;
    EXPECT_EQ(result.objects[0].function.find("man_made="), 0u) << "it has no rooms";
  }
}

TEST(TallThings, WhatHasNoWallsOrNoHeightIsCounted) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes,height=9");
  map.add_rectangle(20, 0, 4, 4, "man_made=mast,height=80");
  map.add_rectangle(30, 0, 4, 4, "man_made=tower,height=80,tower:construction=lattice");
  map.add_rectangle(40, 0, 4, 4, "man_made=chimney");
  map.add_rectangle(50, 0, 4, 4, "man_made=storage_tank");
  map.add_rectangle(60, 0, 4, 4, "man_made=pier,height=3");
  map.add_rectangle(70, 0, 4, 4, "man_made=chimney,height=30,end_date=1990");
  map.add_rectangle(80, 0, 4, 4, "man_made=silo,location=underground");
  map.add_point(90, 0, "man_made=mast,tower:type=lighting,height=9,diameter=2");
  const Read result = read(map);
  EXPECT_EQ(result.objects.size(), 2u) << "the house and the tank";
  const Reasons expected{{"man_made=mast of bars or ropes, not drawn", 1},
                         {"man_made=tower of bars or ropes, not drawn", 1},
                         {"man_made=chimney without a height, not drawn", 1},
                         {"building below the ground, not built or gone", 2}};
  EXPECT_EQ(result.report.skipped, expected);
  EXPECT_EQ(result.report.assumed,
            (Reasons{{"height of a building that the map does not say", 1}}));
}

TEST(TallThings, PointsOfKnownSizesAreRound) {
  constexpr double pi = std::numbers::pi;
  const struct {
    const char* tags;
    double volume;
  } cases[] = {{"man_made=silo,diameter=6,height=12", pi * 9 * 12},
               {"man_made=silo,diameter=6000,height=12", pi * 9 * 12},
               {"man_made=silo,diameter=6 m,height=12", pi * 9 * 12},
               {"man_made=silo,diameter=600 cm,height=12", pi * 9 * 12},
               {"man_made=chimney,diameter=10',height=100'", pi * 25 * 100 * 0.0283168466},
               {"man_made=chimney,width=3,height=40,min_height=10", pi * 2.25 * 30},
               {"man_made=storage_tank,diameter=20,height=10,roof:shape=dome,roof:height=4",
                pi * 100 * 6 + 2.0 / 3 * pi * 100 * 4}};
  for (const auto& [tags, expected] : cases) {
    Map map;
    map.add_point(40, 0, tags);
    const Read result = read(map);
    ASSERT_EQ(result.objects.size(), 1u) << tags;
    EXPECT_EQ(result.objects[0].id, "node/1");
    // The chords of a dome lie within it.
    EXPECT_NEAR(volume(result.objects[0]), expected, 0.02 * expected) << tags;
    EXPECT_TRUE(result.report.skipped.empty()) << tags;
  }
  for (const char* tags :
       {"man_made=silo,diameter=6", "man_made=silo,height=12", "man_made=silo,height=12,diameter=x",
        "man_made=silo,height=12,diameter=900000", "building=silo,height=12,diameter=6"}) {
    Map map;
    map.add_point(40, 0, tags);
    const Read result = read(map);
    EXPECT_TRUE(result.objects.empty()) << tags;
    EXPECT_EQ(
        result.report.skipped,
        (Reasons{
            {"building, tower or tank mapped as a point, without an outline or its sizes", 1}}))
        << tags;
  }
}

TEST(TallThings, NothingStandsTwice) {
  const auto ids = [](const Map& map, std::size_t left_out) {
    const Read result = read(map);
    std::multiset<std::string> ids;
    for (const city::CityObject& object : result.objects) ids.insert(object.function);
    const auto found = result.report.skipped.find(twice);
    EXPECT_EQ(found == result.report.skipped.end() ? 0 : found->second, left_out);
    return ids;
  };
  using Functions = std::multiset<std::string>;
  {
    Map map;  // a chimney in a factory, and one beside it
    map.add_rectangle(0, 0, 100, 60, "building=industrial,height=10");
    map.add_rectangle(40, 30, 5, 5, "man_made=chimney,height=60");
    map.add_rectangle(120, 30, 5, 5, "man_made=chimney,height=60");
    EXPECT_EQ(ids(map, 0), (Functions{"", "man_made=chimney", "man_made=chimney"}));
  }
  {
    Map map;  // outlines of the building beside those of the thing
    map.add_rectangle(0, 0, 10, 10, "building=yes,height=40");
    map.add_rectangle(0.5, 0.5, 9, 9, "man_made=water_tower,height=40");
    map.add_rectangle(50, 0, 30, 30, "building=silo,height=20");
    map.add_rectangle(55, 5, 5, 5, "man_made=silo,height=20");
    map.add_point(70, 20, "man_made=silo,height=20,diameter=5");
    map.add_rectangle(100, 0, 30, 30, "man_made=tower,height=50");
    map.add_rectangle(110, 10, 10, 10, "building:part=yes,height=50");
    EXPECT_EQ(ids(map, 4), (Functions{"", "", ""}));
  }
  {
    Map map;  // a node in the outline of the same thing, and an outline that comes again
    map.add_rectangle(0, 0, 10, 10, "man_made=storage_tank,height=12");
    map.add_point(5, 5, "man_made=storage_tank,height=12,diameter=10");
    map.add_rectangle(0, 0, 10, 10, "man_made=storage_tank,height=12,content=oil");
    EXPECT_EQ(ids(map, 2), (Functions{"man_made=storage_tank"}));
  }
  {
    Map map;  // none of these is the tank
    map.add_rectangle(0, 0, 40, 40, "man_made=storage_tank,height=12");
    map.add_rectangle(18, 18, 4, 4, "building=kiosk");
    map.add_rectangle(0, 0, 40, 40, "building=yes,height=12,end_date=1980");
    EXPECT_EQ(ids(map, 0), (Functions{"", "man_made=storage_tank"}));
  }
}

TEST(TallThings, ABuildingOfAnotherMapStandsForThem) {
  Map map;
  map.add_rectangle(0, 0, 10, 10, "man_made=silo,height=20");
  map.add_rectangle(50, 0, 10, 10, "man_made=silo,height=20");
  Map other;
  for (int i = 0; i < 10; ++i) other.add_point(900 + i, 0, "natural=tree");  // other ids
  other.add_rectangle(0, 0, 10, 10, "building=silo,height=20");
  const TemporaryFile file(map.text(), ".osm"), tile(other.text(), ".osm");
  city::ReadOptions options;
  options.maps =
      std::make_shared<CityMaps>(std::vector<std::filesystem::path>{file.path(), tile.path()});
  std::vector<city::CityObject> objects;
  city::ObjectSink sink = [&](city::CityObject&& o) { objects.push_back(std::move(o)); };
  const city::ReadReport report = read_map_buildings(file.path(), options, city::deliver_to(sink));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(report.skipped.at(twice), 1u);
}

TEST(TallThings, TheNewestVersionOfAPointCounts) {
  const auto count = [](const std::string& nodes) {
    const TemporaryFile file("<osm version='0.6'>" + nodes + "</osm>", ".osm");
    std::size_t objects = 0;
    city::ObjectSink sink = [&](city::CityObject&&) { ++objects; };
    read_map_buildings(file.path(), {}, city::deliver_to(sink));
    return objects;
  };
  const std::string tags =
      "<tag k='man_made' v='silo'/><tag k='height' v='9'/><tag k='width' v='4'/>";
  const auto write = [&](int version, const std::string& inside, const char* more = "") {
    return "<node id='5' version='" + std::to_string(version) + "' lat='1' lon='2'" + more + ">" +
           inside + "</node>";
  };
  EXPECT_EQ(count(write(1, tags)), 1u);
  EXPECT_EQ(count(write(1, tags) + write(2, "")), 0u);
  EXPECT_EQ(count(write(2, tags) + write(1, "")), 1u);
  EXPECT_EQ(count(write(2, "") + write(1, tags)), 0u);
  EXPECT_EQ(count(write(1, tags) + write(2, "", " visible='false'")), 0u);
}

}  // namespace
}  // namespace nightcity::map_buildings
