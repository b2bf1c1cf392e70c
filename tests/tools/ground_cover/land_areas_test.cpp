#include "tools/ground_cover/land_areas.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temp_folder.h"
#include "tests/tools/ground_cover/metre_map.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {
namespace {

osm::MapArea square(double low, double high, osm::OsmTags tags) {
  return {"way/1", std::move(tags), {{{{low, low}, {high, low}, {high, high}, {low, high}}, {}}}};
}

GroundKind kind_of(const osm::OsmTags& tags) {
  const auto use = find_land_use(tags);
  return use ? use->surface.kind : GroundKind::count;
}

TEST(LandAreas, TagsSayWhatTheGroundIs) {
  EXPECT_EQ(kind_of({{"natural", "water"}}), GroundKind::water);
  EXPECT_EQ(kind_of({{"landuse", "forest"}}), GroundKind::woodland);
  EXPECT_EQ(kind_of({{"leisure", "park"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"leisure", "pitch"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"leisure", "pitch"}, {"surface", "tartan"}}), GroundKind::tartan);
  EXPECT_EQ(kind_of({{"natural", "water"}, {"surface", "asphalt"}}), GroundKind::water);
  EXPECT_EQ(kind_of({{"amenity", "parking"}}), GroundKind::asphalt);
  EXPECT_EQ(kind_of({{"highway", "pedestrian"}, {"area", "yes"}}), GroundKind::paving_stones);
  EXPECT_EQ(kind_of({{"area:highway", "primary"}, {"surface", "sett"}}), GroundKind::sett);
}

TEST(LandAreas, WhatIsNoSurfaceIsNoLand) {
  for (const osm::OsmTags& tags :
       {osm::OsmTags{{"landuse", "residential"}}, osm::OsmTags{{"highway", "residential"}},
        osm::OsmTags{{"amenity", "parking"}, {"parking", "underground"}},
        osm::OsmTags{{"natural", "water"}, {"tunnel", "culvert"}},
        osm::OsmTags{{"amenity", "parking"}, {"building", "yes"}},
        osm::OsmTags{{"highway", "footway"}, {"area", "yes"}, {"indoor", "yes"}}, osm::OsmTags{}})
    EXPECT_EQ(kind_of(tags), GroundKind::count);
}

TEST(LandAreas, TheMoreSpecialOfTwoTagsAndAreasIsSeen) {
  EXPECT_EQ(kind_of({{"leisure", "park"}, {"natural", "wood"}}), GroundKind::woodland);
  const std::vector<osm::MapArea> areas{square(-100, 100, {{"leisure", "park"}}),
                                        square(-10, 10, {{"natural", "water"}}),
                                        square(-50, 50, {{"landuse", "cemetery"}})};
  Cover cover;
  add_land(areas, as_metres, bounds, cover);
  cover.finish();
  ASSERT_EQ(cover.areas().size(), 3u);
  EXPECT_EQ(cover.areas()[0].surface.kind, GroundKind::water);
  EXPECT_EQ(cover.areas()[1].rings[0][0].x, -50);  // of one rank the smaller comes first
}

TEST(LandAreas, OfTwoKindsInOneOutlineTheOrderOfTheMapDecidesNothing) {
  std::vector<osm::MapArea> areas{square(-50, 50, {{"leisure", "garden"}}),
                                  square(-50, 50, {{"leisure", "garden"}, {"surface", "gravel"}})};
  GroundKind seen[2];
  for (GroundKind& kind : seen) {
    Cover cover;
    add_land(areas, as_metres, bounds, cover);
    cover.finish();
    ASSERT_EQ(cover.areas().size(), 2u);
    kind = cover.areas()[0].surface.kind;
    std::swap(areas[0], areas[1]);
  }
  EXPECT_EQ(seen[0], seen[1]);
}

TEST(LandAreas, LandIsBelowStreetsOfEveryKind) {
  for (const char* highway : {"footway", "cycleway", "residential", "motorway"}) {
    const auto street = find_land_use({{"area:highway", highway}});
    const auto land = find_land_use({{"railway", "platform"}});
    ASSERT_TRUE(street && land);
    EXPECT_GT(street->rank, land->rank) << highway;
    EXPECT_GT(pavement_rank, land->rank);
  }
}

// OSM wiki: "Key:landcover", "Key:basin", "Tag:natural=wetland", "Key:golf".
TEST(LandAreas, WhatLiesThereComesBeforeWhatTheLandIsFor) {
  EXPECT_EQ(kind_of({{"landcover", "grass"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"landcover", "trees"}}), GroundKind::woodland);
  EXPECT_EQ(kind_of({{"landuse", "forest"}, {"landcover", "grass"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"landuse", "basin"}}), GroundKind::water);
  EXPECT_EQ(kind_of({{"landuse", "basin"}, {"basin", "retention"}}), GroundKind::water);
  EXPECT_EQ(kind_of({{"landuse", "basin"}, {"basin", "infiltration"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"natural", "water"}, {"water", "basin"}, {"basin", "detention"}}),
            GroundKind::grass);
  EXPECT_EQ(kind_of({{"natural", "wetland"}, {"wetland", "reedbed"}}), GroundKind::scrub);
  EXPECT_EQ(kind_of({{"natural", "wetland"}, {"wetland", "tidalflat"}}), GroundKind::soil);
  EXPECT_EQ(kind_of({{"natural", "wetland"}, {"wetland", "saltmarsh"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"natural", "wetland"}, {"wetland", "swamp"}}), GroundKind::woodland);
  EXPECT_EQ(kind_of({{"golf", "fairway"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"golf", "water_hazard"}}), GroundKind::water);
  EXPECT_EQ(kind_of({{"natural", "mud"}}), GroundKind::soil);
  EXPECT_EQ(kind_of({{"aeroway", "helipad"}}), GroundKind::concrete);
  EXPECT_EQ(kind_of({{"leisure", "pitch"}, {"sport", "beachvolleyball"}}), GroundKind::sand);
  EXPECT_EQ(kind_of({{"leisure", "pitch"}, {"sport", "basketball"}}), GroundKind::asphalt);
  EXPECT_EQ(kind_of({{"leisure", "pitch"}, {"sport", "basketball"}, {"surface", "tartan"}}),
            GroundKind::tartan);
  EXPECT_EQ(kind_of({{"landuse", "grass;meadow"}}), GroundKind::grass);
}

// OSM wiki, the pages of these tags.
TEST(LandAreas, RarerKindsOfLandAreKnown) {
  EXPECT_EQ(kind_of({{"leisure", "common"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"landuse", "greenery"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"natural", "dune"}}), GroundKind::sand);
  EXPECT_EQ(kind_of({{"natural", "desert"}}), GroundKind::sand);
  EXPECT_EQ(kind_of({{"landuse", "logging"}}), GroundKind::soil);
  EXPECT_EQ(kind_of({{"landuse", "paddy"}}), GroundKind::farmland);
  EXPECT_EQ(kind_of({{"amenity", "motorcycle_parking"}}), GroundKind::asphalt);
}

TEST(LandAreas, GlaciersAreIce) {
  EXPECT_EQ(kind_of({{"natural", "glacier"}}), GroundKind::ice);
  EXPECT_EQ(kind_of({{"natural", "glacier"}, {"surface", "snow"}}), GroundKind::snow);
  EXPECT_EQ(kind_of({{"landcover", "snow"}}), GroundKind::snow);
}

TEST(LandAreas, AGroundThatNoRowKnowsIsTold) {
  Cover cover;
  const std::vector<osm::MapArea> areas{
      square(0, 10, {{"natural", "moor"}}), square(20, 30, {{"natural", "Moor"}}),
      square(0, 10, {{"landcover", "moss"}}),
      // Elsewhere, a shape of the land, known, in a building, no ground.
      square(9000, 9010, {{"natural", "moor"}}), square(0, 10, {{"natural", "bay"}}),
      square(0, 10, {{"natural", "moor"}, {"landuse", "meadow"}}),
      square(0, 10, {{"natural", "moor"}, {"indoor", "yes"}}),
      square(0, 10, {{"landuse", "residential"}})};
  add_land(areas, as_metres, bounds, cover);
  EXPECT_EQ(cover.left_out, (std::map<std::string, std::size_t>{{"land with natural=moor", 2},
                                                                {"land with landcover=moss", 1}}));
  const osm::AreaSelection land = select_land();
  EXPECT_TRUE(land.wants({{"natural", "moor"}}));
  EXPECT_FALSE(land.wants({{"natural", "bay"}}));
}

TEST(LandAreas, AWayToAPlaceAndBackEnclosesNothingAndIsCounted) {
  const test::TempFolder folder;
  std::ofstream(folder / "map.osm") << R"(<osm version="0.6">
<node id="1" version="1" lon="0" lat="0"/><node id="2" version="1" lon="9" lat="0"/>
<way id="1" version="1"><nd ref="1"/><nd ref="2"/><nd ref="1"/><tag k="landuse" v="grass"/></way>
<way id="2" version="1"><nd ref="1"/><tag k="landuse" v="grass"/></way>
<way id="3" version="1"><nd ref="1"/><nd ref="2"/><tag k="landuse" v="grass"/></way></osm>)";
  const osm::MapAreas map = osm::read_map_areas(folder / "map.osm", select_land(), 1000);
  EXPECT_TRUE(map.areas.empty());
  EXPECT_EQ(map.broken, 2u);
  EXPECT_EQ(map.open_ways, 1u);
}

TEST(LandAreas, StreetsAreAreasWhereTheirTagsSaySo) {
  for (const char* yes : {"yes", "true", "1"})
    EXPECT_EQ(kind_of({{"highway", "pedestrian"}, {"area", yes}}), GroundKind::paving_stones);
  EXPECT_EQ(kind_of({{"highway", "pedestrian"}, {"type", "multipolygon"}}),
            GroundKind::paving_stones);
  EXPECT_EQ(kind_of({{"highway", "pedestrian"}}), GroundKind::count);
  EXPECT_EQ(kind_of({{"area:highway", "traffic_island"}}), GroundKind::paving_stones);
  EXPECT_EQ(kind_of({{"leisure", "track"}}), GroundKind::tartan);
  EXPECT_EQ(kind_of({{"leisure", "track"}, {"area", "no"}}), GroundKind::count);
}

TEST(LandAreas, WhatLiesOnOtherLevelsIsNoGround) {
  for (const osm::OsmTags& tags : {osm::OsmTags{{"amenity", "parking"}, {"layer", "-1"}},
                                   osm::OsmTags{{"leisure", "garden"}, {"level", "3"}},
                                   osm::OsmTags{{"railway", "platform"}, {"level", "-1;-2"}},
                                   osm::OsmTags{{"leisure", "swimming_pool"}, {"covered", "yes"}}})
    EXPECT_EQ(kind_of(tags), GroundKind::count);
  EXPECT_EQ(kind_of({{"leisure", "garden"}, {"level", "0"}}), GroundKind::grass);
  EXPECT_EQ(kind_of({{"railway", "platform"}, {"level", "0;-1"}}), GroundKind::paving_stones);
  EXPECT_EQ(kind_of({{"natural", "water"}, {"layer", "-1"}}), GroundKind::water);
}

TEST(LandAreas, ASurfaceThatIsNotKnownIsCounted) {
  Cover cover;
  const std::vector<osm::MapArea> areas{
      square(-10, 10, {{"amenity", "parking"}, {"surface", "chewing_gum"}})};
  add_land(areas, as_metres, bounds, cover);
  EXPECT_EQ(cover.assumed.at("surface of land whose tag is not known"), 1u);
}

}  // namespace
}  // namespace nightcity::ground_cover
