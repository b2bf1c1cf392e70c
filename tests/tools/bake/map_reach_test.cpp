#include "tools/bake/city/map_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/roads/carriageway.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

TEST(MapReach, ItHoldsThePlacesUpToTheLimit) {
  const std::set<Tile> tiles{{0, 0}, {1, 0}};  // 0 to 500 m, 0 to 250 m
  const auto reach = find_reach(tiles, 250, {{10, 20}, {700, 100}, {-2000, 9e9}}, 300);
  ASSERT_TRUE(reach);
  EXPECT_EQ(reach->low, glm::dvec2(-300, 20));
  EXPECT_EQ(reach->high, glm::dvec2(700, 550));
  EXPECT_FALSE(find_reach({}, 250, {{0, 0}}, 300));
  EXPECT_FALSE(find_reach(tiles, 250, {}, 300));
}

TEST(MapReach, TilesWithPlacesWithinReachAreAdded) {
  std::set<Tile> tiles{{0, 0}};
  add_tiles({{260, -10}, {9e9, 0}}, {{-500, -500}, {750, 750}}, 250, tiles);
  EXPECT_EQ(tiles, (std::set<Tile>{{0, 0}, {1, -1}}));
}

TEST(MapReach, OnlyWhatIsAskedForCounts) {
  osm::OsmData map;
  map.highways = {{1, {{1, 1}, {2, 2}}, {}}};
  map.railways = {{2, {{3, 3}}, {}}};
  map.trees = {{{4, 4}, {}}, {{std::nan(""), 0}, {}}};
  const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
  CoverOptions options;
  EXPECT_EQ(find_map_places(map, options, as_metres).size(), 4u);
  options.trees = trees::Season::none;
  options.rails = false;
  EXPECT_EQ(find_map_places(map, options, as_metres).size(), 2u);
}

// Writes a map of one house and a street that leads 400 m east of it; returns the recipe.
fs::path write_lonely_house(const fs::path& folder, const std::string& more) {
  std::ofstream map(folder / "house.osm");
  map << "<osm version='0.6'>\n";
  int nodes = 0;
  const auto add_node = [&](double east, double north) {
    char text[100];
    std::snprintf(text, sizeof text, "<node id='%d' lon='%.7f' lat='%.7f'/>\n", ++nodes,
                  13.4 + east / 67'900, 52.5 + north / 111'300);
    map << text;
  };
  for (const auto& [east, north] : {std::pair(0, 0), {10, 0}, {10, 10}, {0, 10}})
    add_node(east, north);
  add_node(0, -10);
  add_node(400, -10);
  map << "<way id='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='4'/><nd ref='1'/>"
         "<tag k='building' v='yes'/></way>\n"
         "<way id='2'><nd ref='5'/><nd ref='6'/><tag k='highway' v='residential'/></way></osm>\n";
  std::ofstream(folder / "house.toml") << "[osm]\nfiles = ['house.osm']\n" << more;
  return folder / "house.toml";
}

double find_asphalt_m2(const fs::path& folder, const std::string& more) {
  const BakeReport report = bake(read_recipe(write_lonely_house(folder, more)), folder / "out");
  return report.tiles.cover_m2.at("asphalt");
}

TEST(MapReach, AStreetOfTheMapLiesOnGroundBeyondTheBuildings) {
  const TempFolder folder;
  const double near_m2 = find_asphalt_m2(folder.path(), "[terrain]\nmap_reach_m = 0\n");
  const double all_m2 = find_asphalt_m2(folder.path(), "");
  // The ground ended 50 m beyond the house, which is 10 m wide. There are 340 m more of the street,
  // and its end, which is half a disc.
  const double width_m = roads::read_carriageway({{"highway", "residential"}})->width_m;
  const double more_m2 = 340 * width_m + std::numbers::pi / 8 * width_m * width_m;
  EXPECT_NEAR((all_m2 - near_m2) / more_m2, 1, 0.005);
}

// The plane of a map alone reaches beyond its ground, but the Gulf of Guinea is far from Berlin.
TEST(MapReach, ALampOnTheOtherSideOfTheEarthIsOutsideTheModel) {
  const TempFolder folder;
  std::ofstream(folder / "lamps.csv") << "lon,lat\n13.4003,52.4999\n13.45,52.5\n0.5,0\n52.5,13.4\n";
  const BakeReport report =
      bake(read_recipe(write_lonely_house(folder.path(),
                                          "[lamps]\nlayout = 'never'\n[[lamps.inventories]]\n"
                                          "file = 'lamps.csv'\ncrs = 'EPSG:4326'\n")),
           folder / "out");
  EXPECT_EQ(report.lights.lamps.placed, 2u);
  EXPECT_EQ(report.lights.lamps.left_out.at("outside the model"), 2u);
}

}  // namespace
}  // namespace nightcity::bake
