// Buildings of a map, from maps with known content.
#include "tools/map_buildings/read_map_buildings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tests/tools/map_buildings/metre_map.h"
#include "tools/city/ring.h"
#include "tools/map_buildings/building_tags.h"
#include "tools/map_buildings/file_buildings.h"

namespace nightcity::map_buildings {
namespace {

using namespace test;

TEST(MapBuildings, HeightsComeFromTagsInTheirOrder) {
  const auto volume_of = [](const std::string& tags) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, tags);
    const Read result = read(map);
    return result.objects.empty() ? 0 : volume(result.objects.at(0)) / 60;
  };
  expect_near(volume_of("building=yes,height=9.5"), 9.5);
  expect_near(volume_of("building=yes,height=9.5 m,min_height=2"), 7.5);
  expect_near(volume_of("building=yes,building:levels=4"), 12);
  expect_near(volume_of("building=yes,building:levels=4,building:min_level=1"), 9);
  expect_near(volume_of("building=yes,height=40'"), 12.192);
  expect_near(volume_of("building=yes"), 6);
  expect_near(volume_of("building=garage"), 3);
  expect_near(volume_of("building=yes,height=tall,building:levels=2"), 6);
  // Roofs: levels of the roof stand on those of the building; "height" reaches the roof's top.
  expect_near(volume_of("building=yes,building:levels=2,roof:shape=gabled,roof:height=4"), 8);
  expect_near(volume_of("building=yes,height=10,roof:shape=gabled,roof:levels=1"), 8.5);
  expect_near(volume_of("building=yes,height=10,roof:shape=many"), 10);
  expect_near(volume_of("building=yes,height=10,roof:shape=crosspitched"), 7 + 2);
  // Half of 6 m wide, and two thirds of that in the mean.
  expect_near(volume_of("building=yes,height=10,roof:shape=dome"), 7 + 2);
  // The ridge runs across the way that a gable falls.
  expect_near(volume_of("building=yes,height=10,roof:shape=gabled,roof:direction=E,roof:angle=45"),
              5 + 2.5);
  EXPECT_EQ(volume_of("building=no,height=10"), 0);
  EXPECT_EQ(volume_of("building=yes,location=underground"), 0);
}

TEST(MapBuildings, LevelsAndHeightsAreReadAsPeopleWriteThem) {
  const auto height_of = [](const std::string& tags) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, "building=yes," + tags);
    const Read result = read(map);
    EXPECT_TRUE(result.report.assumed.empty()) << tags;
    return volume(result.objects.at(0)) / 60;
  };
  expect_near(height_of("building:levels=3-4"), 10.5);
  expect_near(height_of("building:levels=10;12"), 36);
  expect_near(height_of("building:levels=~3"), 9);
  expect_near(height_of("building:levels=4 floors"), 12);
  for (const char* ground_and_four : {"G+4", "R+4", "P+4"})
    expect_near(height_of(std::string("building:levels=") + ground_and_four), 15);
  expect_near(height_of("building:levels:aboveground=4"), 12);
  expect_near(height_of("height=10;12"), 12);
  expect_near(height_of("est_height=12"), 12);
  expect_near(height_of("height=0,building:levels=5"), 15);
  expect_near(height_of("height=11,est_height=12"), 11);
}

TEST(MapBuildings, LevelsAreReadAsSeveralCountriesWriteThem) {
  const std::pair<const char*, int> cases[] = {
      {"3F", 3},        {"5階建て", 5},       {"地上5階", 5},      {"地上3階地下1階", 3},
      {"2 andares", 2}, {"térreo", 1},        {"2 pavimentos", 2}, {"G+4", 5},
      {"G + 3", 4},     {"S+4", 5},           {"B+G+4", 5},        {"2B+G+4", 5},
      {"Stilt+4", 5},   {"g+1", 2},           {"parter", 1},       {"parter + 2", 3},
      {"P + 2", 3},     {"5 kondygnacji", 5}, {"3 bouwlagen", 3},  {"2-story", 2}};
  for (const auto& [levels, expected] : cases) {
    city::SkipCounter notes;
    EXPECT_EQ(find_sizes({{"building", "yes"}, {"building:levels", levels}}, notes).storeys,
              expected)
        << levels;
  }
}

TEST(MapBuildings, WordsBehindACountOfLevelsAreTold) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes,building:levels=3 + attic");
  const Read result = read(map);
  expect_near(volume(result.objects.at(0)) / 60, 9);
  EXPECT_EQ(result.report.skipped.at("building:levels=3 + attic, of which the number is used"), 1u);
}

TEST(MapBuildings, TheOutlineOfABuildingRelationHasItsTags) {
  for (const char* outline_tags : {"", "building=yes,height=14"}) {
    Map map;
    const int outline = map.add_rectangle(0, 0, 10, 6, outline_tags),
              part = map.add_rectangle(0, 0, 5, 6, "building:part=yes,height=20");
    map.add_building_relation(outline, part, "building=yes,height=14");
    map.add_rectangle(50, 0, 10, 6, "building=yes,height=9");
    const Read result = read(map);
    ASSERT_EQ(result.objects.size(), 2u) << outline_tags;
    double sum = 0;
    for (const city::CityObject& object : result.objects) sum += volume(object);
    expect_near(sum, 5 * 6 * 20 + 10 * 6 * 9);  // the part stands in place of the outline
  }
  Map map;
  map.add_building_relation(map.add_rectangle(0, 0, 10, 6, ""), 99, "building=yes,height=14");
  expect_near(volume(read(map).objects.at(0)), 10 * 6 * 14);
}

TEST(MapBuildings, BuildingsThatArePointsAreCounted) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes");
  map.add_point(40, 0, "building=house");
  map.add_point(50, 0, "natural=tree");
  const Read result = read(map);
  EXPECT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.report.skipped.at(
                "building, tower or tank mapped as a point, without an outline or its sizes"),
            1u);
}

TEST(MapBuildings, ASpireIsRoofFromItsFootToItsTop) {
  const auto volume_of = [](const std::string& tags) {
    Map map;
    map.add_rectangle(0, 0, 6, 6, tags);
    return volume(read(map).objects.at(0)) / 36;
  };
  expect_near(volume_of("building=yes,height=12,roof:height=12,roof:shape=pyramidal"), 4);
  expect_near(volume_of("building=yes,height=12,roof:height=12.02,roof:shape=pyramidal"), 4);
  expect_near(volume_of("building=yes,height=12,roof:height=12,roof:shape=gabled"), 6);
  expect_near(
      volume_of("building:part=yes,min_height=20,height=40,roof:height=20,roof:shape=pyramidal"),
      20 / 3.0);
  // Three quarters of a height are less than all.
  expect_near(volume_of("building=yes,height=12,roof:height=9,roof:shape=pyramidal"), 3 + 3);
  // A roof that is higher than all leaves half to the walls.
  expect_near(volume_of("building=yes,height=6,roof:height=9,roof:shape=pyramidal"), 3 + 1);
}

TEST(MapBuildings, ARoofIsAsHighAsItsAngleSays) {
  const auto volume_of = [](const std::string& tags) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, tags);
    return volume(read(map).objects.at(0)) / 60;
  };
  // Half of 6 m at 45 degrees are 3 m.
  expect_near(volume_of("building=yes,height=10,roof:shape=gabled,roof:angle=45"), 7 + 1.5);
  expect_near(volume_of("building=yes,building:levels=2,roof:shape=gabled,roof:angle=45"), 6 + 1.5);
  expect_near(volume_of("building=yes,height=10,roof:shape=pyramidal,roof:angle=45"), 7 + 1);
  expect_near(
      volume_of("building=yes,height=10,roof:shape=gabled,roof:orientation=across,roof:angle=45"),
      5 + 2.5);
  // A plane that falls to the north over 6 m, by half of that.
  expect_near(volume_of("building=yes,height=10,roof:shape=skillion,roof:direction=N,"
                        "roof:angle=26.565051177"),
              7 + 1.5);
  // A roof that is higher than all leaves half to the walls, and a height goes before an angle.
  expect_near(volume_of("building=yes,height=4,roof:shape=gabled,roof:angle=80"), 3);
  expect_near(volume_of("building=yes,height=10,roof:shape=gabled,roof:angle=45,roof:height=4"), 8);
}

TEST(MapBuildings, SizesThatAreNotUnderstoodAreNamed) {
  Map map;
  map.add_rectangle(0, 0, 6, 6,
                    "building=yes,height=tall,building:levels=many,roof:shape=skillion,"
                    "roof:direction=left");
  const Read result = read(map);
  EXPECT_EQ(result.report.skipped.at("height=tall, not understood"), 1u);
  EXPECT_EQ(result.report.skipped.at("building:levels=many, not understood"), 1u);
  EXPECT_EQ(result.report.skipped.at("roof:direction=left, not understood"), 1u);
}

TEST(MapBuildings, WhatHasEndedOrHasNotBegunIsNotBuilt) {
  const auto is_built = [](const std::string& tags) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, "building=yes," + tags);
    return !read(map).objects.empty();
  };
  for (const char* tags :
       {"end_date=1995", "end_date=1990s", "start_date=9998-05", "demolished=yes", "razed=yes",
        "demolished=2019", "dismantled=2015-06", "opening_date=9998",
        "end_date=2015-06-30T12:00:00Z", "building:levels=0,building:levels:underground=2"})
    EXPECT_FALSE(is_built(tags)) << tags;
  for (const char* tags :
       {"end_date=9998", "start_date=1890", "end_date=soon", "demolished=no", "demolished=9998",
        "building:levels=0,building:levels:underground=1,roof:levels=1"})
    EXPECT_TRUE(is_built(tags)) << tags;
}

TEST(MapBuildings, TheYearIsThatOfTheBeginning) {
  const auto year_of = [](const std::string& date) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, "building=yes,start_date=" + date);
    return read(map).objects.at(0).year;
  };
  EXPECT_EQ(year_of("1890-05-01"), "1890");
  EXPECT_EQ(year_of("~1890"), "1890");
  EXPECT_EQ(year_of("1890s"), "1890");
  EXPECT_EQ(year_of("before 1950"), "1950");
  EXPECT_EQ(year_of("old"), "");
}

TEST(MapBuildings, PartsStandInPlaceOfTheirOutline) {
  Map map;
  map.add_rectangle(
      0, 0, 20, 10,
      "building=church,height=30,building:levels=3,addr:street=Hill,start_date=1890-05");
  map.add_rectangle(0, 0, 10, 10, "building:part=yes,height=8");
  map.add_rectangle(10, 0, 10, 10,
                    "building:part=tower,height=30,roof:shape=pyramidal,roof:height=6");
  map.add_rectangle(100, 0, 5, 5, "building:part=yes,height=4");
  const Read result = read(map);
  ASSERT_EQ(result.objects.size(), 2u);
  expect_near(volume(result.objects[0]), 800 + 2400 + 200);
  EXPECT_EQ(result.objects[0].storeys_above_ground, 3);
  EXPECT_EQ(result.objects[0].measured_height_m, 30);
  EXPECT_EQ(result.objects[0].year, "1890");
  EXPECT_EQ(result.objects[0].address, "Hill");
  EXPECT_EQ(result.objects[0].type, city::ObjectType::building);
  EXPECT_TRUE(result.objects[0].id.starts_with("way/"));
  expect_near(volume(result.objects[1]), 100);
  EXPECT_EQ(result.report.skipped.at("outline of a building that has parts"), 1u);
}

// A closed way round a rectangle, with nodes of its own.
std::string write_way(int id, double x, double width, const std::string& tags) {
  std::string nodes, refs;
  for (int k = 0; k < 5; ++k) {
    const int corner = k % 4;
    char text[120];
    std::snprintf(text, sizeof text, "<node id='%d' lat='%.7f' lon='%.7f'/>", 10 * id + corner,
                  (corner < 2 ? 0 : 10) / lat_m,
                  10 + (corner == 1 || corner == 2 ? x + width : x) / lon_m);
    if (k < 4) nodes += text;
    refs += "<nd ref='" + std::to_string(10 * id + corner) + "'/>";
  }
  return nodes + "<way id='" + std::to_string(id) + "'>" + refs + tags + "</way>";
}

// Reads the maps in turn, as one city.
std::vector<Read> read_all(const std::vector<std::string>& texts) {
  std::list<TemporaryFile> files;
  std::vector<std::filesystem::path> maps;
  for (const std::string& text : texts) {
    files.emplace_back("<osm>" + text + "</osm>", ".osm");
    maps.push_back(files.back().path());
  }
  city::ReadOptions options;
  options.maps = std::make_shared<CityMaps>(maps);
  std::vector<Read> all(maps.size());
  for (std::size_t i = 0; i < maps.size(); ++i) {
    city::ObjectSink sink = [&](city::CityObject&& o) { all[i].objects.push_back(std::move(o)); };
    all[i].report = read_map_buildings(maps[i], options, city::deliver_to(sink));
  }
  return all;
}

TEST(MapBuildings, ABuildingAtASeamHasThePartsOfEachTile) {
  const std::string house =
                        write_way(1, 0, 20, "<tag k='building' v='yes'/><tag k='height' v='30'/>"),
                    low = write_way(2, 0, 10,
                                    "<tag k='building:part' v='yes'/><tag k='height' v='8'/>"),
                    high = write_way(3, 10, 10,
                                     "<tag k='building:part' v='yes'/><tag k='height' v='30'/>");
  const std::vector<Read> whole = read_all({house + low + high}),
                          tiles = read_all({house + low, house + high}),
                          apart = read_all({high, house, low});
  ASSERT_EQ(whole[0].objects.size(), 1u);
  expect_near(volume(whole[0].objects[0]), 800 + 3000);
  for (const Read& tile : tiles) {
    ASSERT_EQ(tile.objects.size(), 1u);
    EXPECT_EQ(tile.objects[0].id, "way/1");
    expect_near(volume(tile.objects[0]), 800 + 3000);
  }
  EXPECT_EQ(tiles[0].objects[0].polygons.front().exterior,
            tiles[1].objects[0].polygons.front().exterior)
      << "the bake knows it again";
  EXPECT_EQ(apart[0].objects.size() + apart[2].objects.size(), 0u) << "parts of another's building";
  expect_near(volume(apart[1].objects.at(0)), 800 + 3000);
}

TEST(MapBuildings, AnOutlineOfAMultipolygonInAnotherTileIsNone) {
  const std::string tags = "<tag k='building' v='yes'/><tag k='height' v='5'/>",
                    outer = write_way(1, 0, 20, tags),
                    relation =
                        "<relation id='7'><member type='way' ref='1' role='outer'/>"
                        "<tag k='type' v='multipolygon'/>" +
                        tags + "</relation>";
  const std::vector<Read> tiles = read_all({outer, outer + relation});
  EXPECT_EQ(tiles[0].objects.size(), 0u);
  ASSERT_EQ(tiles[1].objects.size(), 1u);
  EXPECT_EQ(tiles[1].objects[0].id, "relation/7");
}

TEST(MapBuildings, MultipolygonsHaveCourtyards) {
  Map map;
  const int outer = map.add_rectangle(0, 0, 30, 20, ""),
            inner = map.add_rectangle(10, 5, 10, 10, "");
  map.add_multipolygon(outer, inner, "building=yes,height=10");
  const Read result = read(map);
  ASSERT_EQ(result.objects.size(), 1u);
  expect_near(volume(result.objects[0]), (600 - 100) * 10);
  EXPECT_TRUE(result.objects[0].id.starts_with("relation/"));
}

// The tags of multipolygons were on their outer ways until 2017.
TEST(MapBuildings, CourtyardsOfMultipolygonsWhoseOuterWaySaysWhatTheyAre) {
  for (const char* relation : {"", "name=Court", "building=yes", "building=apartments,height=10"}) {
    Map map;
    const int outer = map.add_rectangle(0, 0, 30, 20, "building=yes,height=10"),
              inner = map.add_rectangle(10, 5, 10, 10, "");
    map.add_multipolygon(outer, inner, relation);
    const Read result = read(map);
    ASSERT_EQ(result.objects.size(), 1u) << relation;
    expect_near(volume(result.objects[0]), (600 - 100) * 10);
    EXPECT_TRUE(result.report.skipped.empty()) << relation;
  }
  // A hole with the tags of its outline is a hole, another building in it stands.
  for (const auto& [tags, objects] :
       {std::pair("building=yes,height=10", 1u), std::pair("building=shed,height=10", 2u)}) {
    Map map;
    const int outer = map.add_rectangle(0, 0, 30, 20, "building=yes,height=10"),
              inner = map.add_rectangle(10, 5, 10, 10, tags);
    map.add_multipolygon(outer, inner, "");
    EXPECT_EQ(read(map).objects.size(), objects) << tags;
  }
  // A relation about something else leaves the way alone.
  Map map;
  const int outer = map.add_rectangle(0, 0, 30, 20, "building=yes,height=10"),
            inner = map.add_rectangle(10, 5, 10, 10, "");
  map.add_multipolygon(outer, inner, "landuse=residential");
  const Read result = read(map);
  ASSERT_EQ(result.objects.size(), 1u);
  expect_near(volume(result.objects[0]), 600 * 10);
}

TEST(MapBuildings, EachRingOfAnUntaggedMultipolygonHasItsOwnTags) {
  // Two houses in one relation, the second with a courtyard; a bare way; a part below a building.
  const auto relation = [](std::initializer_list<std::pair<int, const char*>> members,
                           const char* tags) {
    std::string text = "<relation id=\"900\" version=\"1\">";
    for (const auto& [way, role] : members)
      text += "<member type=\"way\" ref=\"" + std::to_string(way) + "\" role=\"" + role + "\"/>";
    return text + "<tag k=\"type\" v=\"multipolygon\"/>" + tags + "</relation></osm>";
  };
  const auto read_with = [](const Map& map, const std::string& more) {
    std::string text = map.text();
    text.replace(text.find("</osm>"), 6, more);
    const TemporaryFile file(text, ".osm");
    std::map<std::string, double> volumes;
    const city::ObjectSink sink = [&](city::CityObject&& o) { volumes[o.id] = volume(o); };
    read_map_buildings(file.path(), {}, city::deliver_to(sink));
    return volumes;
  };
  Map map;
  const int a = map.add_rectangle(0, 0, 10, 10, "building=yes,height=10"),
            b = map.add_rectangle(50, 0, 30, 20, "building=yes,height=20"),
            hole = map.add_rectangle(60, 5, 10, 10, ""),
            bare = map.add_rectangle(100, 0, 10, 10, "");
  const std::string first = "way/" + std::to_string(a), second = "way/" + std::to_string(b);
  for (const char* role : {"outer", ""}) {
    const char* inner = *role ? "inner" : "";
    const auto volumes =
        read_with(map, relation({{a, role}, {b, role}, {hole, inner}, {bare, role}},
                                "<tag k=\"source\" v=\"survey\"/>"));
    ASSERT_EQ(volumes.size(), 2u) << role;
    expect_near(volumes.at(first), 1000);
    expect_near(volumes.at(second), (600 - 100) * 20);
  }
  // Tags of the relation that say nothing about what it is belong to its rings.
  expect_near(
      read_with(map, relation({{b, "outer"}, {hole, "inner"}}, "<tag k=\"min_height\" v=\"5\"/>"))
          .at(second),
      (600 - 100) * 15);
  // A member that is not there: the way stands as it is.
  expect_near(read_with(map, relation({{b, "outer"}, {777, "inner"}}, "")).at(second), 600 * 20);
  // Not a multipolygon.
  std::string site = relation({{b, "outer"}, {hole, "inner"}}, "");
  site.replace(site.find("multipolygon"), 12, "site");
  expect_near(read_with(map, site).at(second), 600 * 20);
  // The way says more than the relation, which counts where both speak.
  const auto both = read_with(map, relation({{b, "outer"}, {hole, "inner"}},
                                            "<tag k=\"building\" v=\"church\"/>"
                                            "<tag k=\"height\" v=\"30\"/>"));
  expect_near(both.at("relation/900"), (600 - 100) * 30);
  EXPECT_FALSE(both.contains(second));
}

TEST(MapBuildings, AnOutlineCutIntoTaggedWaysIsOneBuilding) {
  const std::string nodes =
      "<node id='1' lat='0' lon='10'/><node id='2' lat='0' lon='10.0003'/>"
      "<node id='3' lat='0.0003' lon='10.0003'/><node id='4' lat='0.0003' lon='10'/>";
  const auto way = [](int id, const char* refs, const char* tag) {
    return "<way id='" + std::to_string(id) + "'>" + refs + tag + "</way>";
  };
  const char *first = "<nd ref='1'/><nd ref='2'/><nd ref='3'/>",
             *second = "<nd ref='3'/><nd ref='4'/><nd ref='1'/>",
             *tag = "<tag k='building' v='yes'/>";
  // Two that say different things are no area together, and are counted as ways that are open.
  for (const char* other : {tag, "", "<tag k='building:part' v='yes'/>"}) {
    const TemporaryFile file("<osm version='0.6'>" + nodes + way(10, first, tag) +
                                 way(11, second, other) +
                                 "<relation id='20'><member type='way' ref='10' role='outer'/>"
                                 "<member type='way' ref='11' role='outer'/>"
                                 "<tag k='type' v='multipolygon'/></relation></osm>",
                             ".osm");
    std::vector<std::string> ids;
    const city::ObjectSink sink = [&](city::CityObject&& o) { ids.push_back(o.id); };
    const city::ReadReport report = read_map_buildings(file.path(), {}, city::deliver_to(sink));
    if (std::string_view(other).find("part") != std::string_view::npos) {
      EXPECT_TRUE(ids.empty());
      EXPECT_EQ(report.skipped.at("outline that crosses itself, is open or incomplete"), 2u);
      continue;
    }
    EXPECT_EQ(ids, std::vector<std::string>{"relation/20"});
    EXPECT_TRUE(report.skipped.empty());
  }
}

// 4,000 rings of 4,000 ways: the time must not grow with their product (16 million comparisons of
// ways with rings took most of the run), for a relation of either kind.
TEST(MapBuildings, ThousandsOfRingsOfOneRelationAreBuildings) {
  constexpr int rings = 4000;
  for (const bool tagged : {false, true}) {
    Map map;
    std::string members;
    for (int n = 0; n < rings; ++n) {
      const int way =
          map.add_rectangle(20.0 * (n % 64), 20.0 * (n / 64), 10, 10, "building=yes,height=9");
      members += "<member type='way' ref='" + std::to_string(way) + "' role='outer'/>";
    }
    std::string text = map.text();
    text.insert(text.rfind("</osm>"), "<relation id='9000000' version='1'>" + members +
                                          "<tag k='type' v='multipolygon'/>" +
                                          (tagged ? "<tag k='building' v='yes'/>" : "") +
                                          "</relation>");
    const TemporaryFile file(text, ".osm");
    city::ReadOptions options;
    options.max_way_nodes = 5 * rings;
    std::size_t of_ways = 0, of_relations = 0;
    const city::ObjectSink sink = [&](city::CityObject&& o) {
      ++(o.id.starts_with("way/") ? of_ways : of_relations);
    };
    const city::ReadReport report =
        read_map_buildings(file.path(), options, city::deliver_to(sink));
    EXPECT_TRUE(report.skipped.empty());
    EXPECT_EQ(of_ways, tagged ? 0u : static_cast<std::size_t>(rings));
    EXPECT_EQ(of_relations > 0, tagged);
  }
}

// A part that does not stand takes no outline away.
TEST(MapBuildings, AnOutlineStandsWhereAllItsPartsAreGone) {
  for (const char* tags : {"building:part=no,height=30", "building:part=yes,end_date=2001",
                           "building:part=yes,building:levels=0,building:levels:underground=2"}) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, "building=yes,height=12");
    map.add_rectangle(0, 0, 5, 6, tags);
    const Read result = read(map);
    ASSERT_EQ(result.objects.size(), 1u) << tags;
    expect_near(volume(result.objects[0]), 10 * 6 * 12);
    EXPECT_EQ(result.report.skipped.at("part of a building below the ground, not built or gone"),
              1u);
    EXPECT_FALSE(result.report.skipped.contains("outline of a building that has parts"));
  }
}

TEST(MapBuildings, ShapesOfRoofsHaveOtherNames) {
  for (const char* shape : {"roof:shape=lean_to", "roof:shape=shed", "building:roof:shape=skillion",
                            "roof:shape=gable", "roof:shape=hip"}) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, std::string("building=yes,height=12,roof:height=3,") + shape);
    const Read result = read(map);
    const std::string name = shape;
    // A slope and a ridge have half of a block's volume, hips of 45 degrees seen from above less.
    const double under_roof = name.ends_with("hip") ? 60 * 3 / 2.0 - 6 * 6 * 3 / 6.0 : 60 * 3 / 2.0;
    expect_near(volume(result.objects.at(0)), 60 * 9 + under_roof);
    EXPECT_TRUE(result.report.skipped.empty()) << shape;
  }
}

TEST(MapBuildings, EachShapeOfTheWikiIsBuiltOrToldAsAnother) {
  const auto read_shape = [](const std::string& shape) {
    Map map;
    map.add_rectangle(0, 0, 20, 8, "building=yes,height=12,roof:height=3,roof:shape=" + shape);
    return read(map);
  };
  for (const char* shape :
       {"butterfly", "sawtooth", "gabled_row", "double_saltbox", "quadruple_saltbox", "side_hipped",
        "side_half-hipped", "hipped-and-gabled", "crosspitched", "Barrel"}) {
    const Read result = read_shape(shape);
    EXPECT_TRUE(result.report.skipped.empty()) << shape;
    EXPECT_LT(volume(result.objects.at(0)), 160 * 12 - 1) << shape;
    EXPECT_GT(volume(result.objects.at(0)), 160 * 9 + 1) << shape;
  }
  const Read near = read_shape("zakopane");
  EXPECT_EQ(near.report.skipped.at("roof:shape=zakopane, shown as hipped"), 1u);
  EXPECT_LT(volume(near.objects.at(0)), 160 * 12 - 1);
}

TEST(MapBuildings, WhatIsAssumedOrNotShownIsCounted) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes");
  map.add_rectangle(20, 0, 10, 6, "building=yes,height=9,roof:shape=many");
  map.add_rectangle(40, 0, 10, 6, "building=yes,height=3,min_height=5");
  map.add_rectangle(60, 0, 10, 6, "building=construction,height=3");
  const Read result = read(map);
  EXPECT_EQ(result.objects.size(), 3u);
  EXPECT_EQ(result.report.assumed.at("height of a building that the map does not say"), 1u);
  EXPECT_EQ(result.report.skipped.at("roof:shape=many, shown flat"), 1u);
  EXPECT_EQ(result.report.skipped.at("building whose min_height is not below its height"), 1u);
  EXPECT_EQ(result.report.skipped.at("building below the ground, not built or gone"), 1u);
}

TEST(MapBuildings, OutlinesThatEncloseNothingAreCountedAndNothingElseIsLost) {
  const std::string nodes =
      "<node id=\"1\" lat=\"0\" lon=\"10\"/><node id=\"2\" lat=\"0\" lon=\"10.0001\"/>"
      "<node id=\"3\" lat=\"0.0001\" lon=\"10.0001\"/><node id=\"4\" lat=\"0.0001\" lon=\"10\"/>";
  const auto way = [](int id, std::initializer_list<int> refs) {
    std::string text = "<way id=\"" + std::to_string(id) + "\">";
    for (const int ref : refs) text += "<nd ref=\"" + std::to_string(ref) + "\"/>";
    return text + "<tag k=\"building\" v=\"yes\"/></way>";
  };
  const TemporaryFile file("<osm version=\"0.6\">" + nodes + way(10, {1, 2, 3, 4, 1}) +
                               way(11, {1, 3, 2, 4, 1}) + way(12, {1, 2}) + way(13, {1, 2, 1}) +
                               way(14, {90, 91, 92, 90}) + "</osm>",
                           ".osm");
  std::vector<std::string> ids;
  const city::ObjectSink sink = [&](city::CityObject&& o) { ids.push_back(o.id); };
  const city::ReadReport report = read_map_buildings(file.path(), {}, city::deliver_to(sink));
  EXPECT_EQ(ids, std::vector<std::string>{"way/10"});
  EXPECT_EQ(report.skipped.at("outline that crosses itself, is open or incomplete"), 4u);
}

// A way of five nodes, and a multipolygon of two such ways.
TEST(MapBuildings, AreasOfTooManyNodesAreLeftOutAndCounted) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes");
  const int outer = map.add_rectangle(50, 0, 20, 20, ""),
            inner = map.add_rectangle(55, 5, 5, 5, "");
  map.add_multipolygon(outer, inner, "building=yes");
  const TemporaryFile file(map.text(), ".osm");
  const auto read_with = [&](int max_way_nodes) {
    city::ReadOptions options;
    options.max_way_nodes = max_way_nodes;
    std::size_t objects = 0;
    const city::ObjectSink sink = [&](city::CityObject&&) { ++objects; };
    const city::ReadReport report =
        read_map_buildings(file.path(), options, city::deliver_to(sink));
    const auto noted = report.skipped.find("building of more nodes than [osm] max_way_nodes = " +
                                           std::to_string(max_way_nodes));
    EXPECT_FALSE(report.skipped.contains("outline that crosses itself, is open or incomplete"));
    return std::pair(objects, noted == report.skipped.end() ? 0 : noted->second);
  };
  EXPECT_EQ(read_with(10), std::pair(std::size_t{2}, std::size_t{0}));
  EXPECT_EQ(read_with(9), std::pair(std::size_t{1}, std::size_t{1}));
  EXPECT_EQ(read_with(4), std::pair(std::size_t{0}, std::size_t{2}));
}

// libosmium looks at all members of one way for each relation that has it.
TEST(MapBuildings, MultipolygonsBeyondThe64thOfOneWayAreLeftOutAndCounted) {
  Map map;
  const int outer = map.add_rectangle(0, 0, 20, 20, ""), inner = map.add_rectangle(5, 5, 5, 5, "");
  for (int i = 0; i < 20'000; ++i) map.add_multipolygon(outer, inner, "building=yes");
  const TemporaryFile file(map.text(), ".osm");
  std::size_t objects = 0;
  const city::ObjectSink sink = [&](city::CityObject&&) { ++objects; };
  const city::ReadReport report = read_map_buildings(file.path(), {}, city::deliver_to(sink));
  EXPECT_EQ(objects, 1u);
  EXPECT_EQ(report.skipped.at("building that the map has twice, with the same corners"), 63u);
  EXPECT_EQ(report.skipped.at("building of more nodes than [osm] max_way_nodes = 20000"), 19'936u);
}

TEST(MapBuildings, SizesStayConsistentWhateverTheTagsSay) {
  city::SkipCounter notes;
  for (const char* height : {"", "0", "0.1", "5", "1000", "1e9", "-3", "nan", "x"})
    for (const char* low : {"", "0", "4.9", "50", "nan"})
      for (const char* roof : {"", "0", "5", "900"})
        for (const char* kind : {"yes", "roof"}) {
          osm::OsmTags tags{{"building", kind}, {"roof:shape", "gabled"}};
          if (*height) tags["height"] = height;
          if (*low) tags["min_height"] = low;
          if (*roof) tags["roof:height"] = roof;
          const BuildingSizes s = find_sizes(tags, notes);
          EXPECT_GE(s.foot_m, 0);
          EXPECT_LT(s.foot_m, s.eaves_m) << height << " " << low << " " << roof << " " << kind;
          EXPECT_LE(s.eaves_m, s.top_m);
          EXPECT_LE(s.top_m, 1000);
        }
}

TEST(MapBuildings, TheHeadLiesWhereTheMapDoes) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes");
  const TemporaryFile file(map.text(), ".osm");
  const city::CityHead head = read_map_head(file.path());
  EXPECT_EQ(head.srs_name, "EPSG:4326");
  ASSERT_EQ(head.sample.size(), 5u);
  EXPECT_NEAR(head.sample[0].x, 10, 0.001);
  EXPECT_NEAR(head.sample[0].y, 0, 0.001);
}

TEST(MapBuildings, ATagWithAZeroByteIsAnError) {
  const auto file = std::filesystem::path(NIGHTCITY_SOURCE_DIR) /
                    "tests/tools/osm/corpus/zero_byte_in_tag.osm.pbf";
  const city::ObjectSink nothing = [](city::CityObject&&) {};
  EXPECT_THROW(read_map_buildings(file, {}, city::deliver_to(nothing)), Error);
}

TEST(MapBuildings, APackedMapMayHoldItsElementsInAnyOrder) {
  Map map;
  const int outer = map.add_rectangle(0, 0, 20, 20, ""),
            inner = map.add_rectangle(5, 5, 10, 10, "");
  map.add_multipolygon(outer, inner, "building=yes,height=10");
  map.add_rectangle(40, 0, 10, 6, "building=yes,height=9");
  const TemporaryFile file(map.text_in_no_order(), ".osm");
  const std::string packed = file.path().string() + ".gz";
  if (std::system(("gzip -c " + file.path().string() + " > " + packed).c_str()) != 0)
    GTEST_SKIP() << "gzip is absent";
  std::vector<double> volumes;
  const city::ObjectSink sink = [&](city::CityObject&& o) { volumes.push_back(volume(o)); };
  const city::ReadReport report = read_map_buildings(packed, {}, city::deliver_to(sink));
  std::filesystem::remove(packed);
  ASSERT_EQ(volumes.size(), 2u);
  std::sort(volumes.begin(), volumes.end());
  expect_near(volumes[0], 60 * 9);
  expect_near(volumes[1], 300 * 10);
  EXPECT_TRUE(report.skipped.empty());
}

TEST(MapBuildings, BrokenMapsAreErrors) {
  for (const char* text :
       {"<osm version=\"0.6\"><node id=\"1\"", "<osm><way", "not a map", "\x1f\x8b"}) {
    const TemporaryFile file(text, ".osm");
    const city::ObjectSink nothing = [](city::CityObject&&) {};
    EXPECT_THROW(read_map_buildings(file.path(), {}, city::deliver_to(nothing)), Error) << text;
  }
}

TEST(MapBuildings, FractionsOfLevelsAndGroundFloorsAreRead) {
  for (const auto& [text, levels] : {std::pair("1½", 1.5),
                                     {"2 1/2", 2.5},
                                     {"½", 0.5},
                                     {"EG+3", 4.0},
                                     {"4F", 4.0},
                                     {"4 fl.", 4.0},
                                     {"4 этажа", 4.0},
                                     {"4층", 4.0}}) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, std::string("building=yes,building:levels=") + text);
    const Read result = read(map);
    expect_near(volume(result.objects.at(0)) / 60, 3 * levels);
    EXPECT_TRUE(result.report.skipped.empty()) << text;
  }
}

TEST(MapBuildings, APartThatIsNoBuildingStands) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=no,building:part=yes,height=9");
  map.add_rectangle(50, 0, 10, 6, "building=no,building:part=no,height=9");
  const Read result = read(map);
  ASSERT_EQ(result.objects.size(), 1u);
  expect_near(volume(result.objects[0]) / 60, 9);
}

TEST(MapBuildings, APartWithoutAHeightHasThatOfItsBuilding) {
  const auto volume_of = [](const std::string& building, const std::string& part) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, building);
    map.add_rectangle(0, 0, 5, 6, part);
    const Read result = read(map);
    return std::pair(volume(result.objects.at(0)) / 30, result.report.assumed);
  };
  const std::string part = "building:part=yes";
  const auto [height, assumed] = volume_of("building=yes,height=20", part);
  expect_near(height, 20);
  EXPECT_EQ(assumed.at("height of a part of a building, as the building's"), 1u);
  EXPECT_EQ(assumed.size(), 1u);
  expect_near(volume_of("building=yes,building:levels=4", part).first, 12);
  expect_near(volume_of("building=yes,height=20", part + ",min_height=8").first, 12);
  expect_near(volume_of("building=yes,height=20", part + ",building:levels=3").first, 9);
  // It begins above the building's top, or nobody says a height.
  expect_near(volume_of("building=yes,height=5", part + ",min_height=8").first, 6);
  expect_near(volume_of("building=yes", part).first, 6);
}

// Imports and slips leave two closed ways in one place, of which each had walls, windows and light.
TEST(MapBuildings, ABuildingThatTheMapHasTwiceStandsOnce) {
  const std::string twice = "building that the map has twice, with the same corners";
  const auto read_two = [](const std::string& first, const std::string& second) {
    Map map;
    map.add_rectangle(0, 0, 10, 6, first);
    map.add_rectangle(0, 0, 10, 6, second);
    map.add_rectangle(0, 0, 10, 6.5, "building=yes,height=1");  // another one
    return read(map);
  };
  const auto sum = [](const Read& result) {
    double all = -65;
    for (const city::CityObject& object : result.objects) all += volume(object);
    return all / 60;
  };
  const Read same = read_two("building=yes,height=9", "building=yes,height=9");
  expect_near(sum(same), 9);
  EXPECT_EQ(same.report.skipped.at(twice), 1u);
  // The one that says more stands.
  expect_near(sum(read_two("building=yes", "building=yes,height=9")), 9);
  expect_near(sum(read_two("building=yes,height=9", "building=yes")), 9);
  // They stand on each other, or one of them is gone.
  for (const char* other :
       {"building=yes,height=12,min_height=9", "building=yes,height=12,layer=1"})
    EXPECT_FALSE(read_two("building=yes,height=9", other).report.skipped.contains(twice)) << other;
  expect_near(sum(read_two("building=yes,height=9", "building=demolished,height=30,name=A")), 9);
}

TEST(MapBuildings, PartsOfABuildingThatTheMapHasTwiceBelongToTheOne) {
  Map map;
  map.add_rectangle(0, 0, 10, 6, "building=yes");
  map.add_rectangle(0, 0, 10, 6, "building=yes,name=A");
  map.add_rectangle(0, 0, 5, 6, "building:part=yes,height=9");
  const Read result = read(map);
  ASSERT_EQ(result.objects.size(), 1u);
  expect_near(volume(result.objects[0]) / 30, 9);
}

}  // namespace
}  // namespace nightcity::map_buildings
