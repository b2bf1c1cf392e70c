// Latitudes, longitudes and names of streets through whole bakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/bake/bake.h"
#include "tools/georeference/frame.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

constexpr double lon = 13.4, lat = 52.5;

// Writes a map without a city model: four houses around a crossing of two streets with names, one
// of which begins far outside, and a square. Returns the recipe.
fs::path write_map_with_names(const fs::path& folder, const char* name, bool backwards = false) {
  std::string nodes, ways;
  int node = 0, way = 0;
  const auto add = [&](const std::vector<glm::dvec2>& line, bool closed, const std::string& tags) {
    std::string text = "<way id='" + std::to_string(backwards ? 100 - ++way : ++way) + "'>";
    const int first = node + 1;
    for (const glm::dvec2& metres : line) {
      char place[100];
      std::snprintf(place, sizeof place, "<node id='%d' lon='%.7f' lat='%.7f'/>\n", ++node,
                    lon + metres.x / 67'900, lat + metres.y / 111'300);
      nodes += place;
      text += "<nd ref='" + std::to_string(node) + "'/>";
    }
    if (closed) text += "<nd ref='" + std::to_string(first) + "'/>";
    text += tags + "</way>\n";
    ways = backwards ? text + ways : ways + text;
  };
  const auto tag = [](const std::string& key, const std::string& value) {
    return "<tag k='" + key + "' v='" + value + "'/>";
  };
  for (const double x : {-60.0, 40.0})
    for (const double y : {-60.0, 40.0})
      add({{x, y}, {x + 20, y}, {x + 20, y + 20}, {x, y + 20}}, true, tag("building", "yes"));
  add({{-3000, 0}, {0, 0}, {60, 0}}, false,
      tag("highway", "residential") + tag("name", "Große Straße"));
  add({{0, -60}, {0, 60}}, false, tag("highway", "pedestrian") + tag("name", "Gasse"));
  add({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, true,
      tag("place", "square") + tag("name", "Markt"));
  add({{-50, 20}, {50, 20}}, false, tag("highway", "residential"));
  std::ofstream(folder / (std::string(name) + ".osm"))
      << "<osm version='0.6'>\n" + nodes + ways + "</osm>\n";
  std::ofstream(folder / (std::string(name) + ".toml"))
      << "[osm]\nfiles = ['" << name << ".osm']\n[terrain]\nmap_reach_m = 0\n";
  return folder / (std::string(name) + ".toml");
}

TEST(BakePlaces, StreetsOfTheMapAreInTheSceneWithTheirNames) {
  const TempFolder folder;
  const BakeReport report =
      bake(read_recipe(write_map_with_names(folder.path(), "map")), folder / "out");
  const Scene scene = read_scene(folder / "out/city.glb");
  EXPECT_TRUE(scene.skipped.empty());
  ASSERT_EQ(scene.places.streets.size(), 3u);
  EXPECT_EQ(report.places.names, 3u);
  EXPECT_EQ(scene.places.streets[0].name, "Gasse");
  EXPECT_EQ(scene.places.streets[1].name, "Große Straße");
  EXPECT_EQ(scene.places.streets[2].name, "Markt");
  EXPECT_EQ(scene.places.streets[2].lines,
            (decltype(scene.places.streets[2].lines){{scene.places.streets[2].lines[0][0]}}));
  // The street begins where the model does, and not 3 km to the west of it.
  const std::vector<glm::dvec2>& line = scene.places.streets[1].lines.at(0);
  EXPECT_EQ(line.size(), 2u);
  EXPECT_LT(glm::distance(line.front(), line.back()), 500);
  EXPECT_GT(glm::distance(line.front(), line.back()), 110);
  // The crossing of all three has the latitude and longitude that the map gives it.
  ASSERT_TRUE(scene.places.geographic);
  const glm::dvec2 crossing = scene.places.streets[2].lines[0][0];
  const glm::dvec3 place = scene.georeference.from_model({crossing.x, 0, crossing.y});
  const auto degrees = to_degrees(*scene.places.geographic, glm::dvec2(place));
  ASSERT_TRUE(degrees);
  EXPECT_NEAR(degrees->x, lat, 0.2 / 111'300);
  EXPECT_NEAR(degrees->y, lon, 0.2 / 67'900);
  EXPECT_LE(*report.places.degrees_error_m, 0.01);
  EXPECT_GT(report.places.bytes, 300u);
  EXPECT_LT(report.places.bytes, 2000u);
}

TEST(BakePlaces, DependNeitherOnPartsNorOnTheOrderOfTheMap) {
  const TempFolder folder;
  expect_parts_as_whole(write_map_with_names(folder.path(), "map"), folder.path(), {3});
  bake(read_recipe(write_map_with_names(folder.path(), "back", true)), folder / "back");
  const auto streets_of = [](const fs::path& glb) { return read_scene(glb).places.streets; };
  const auto once = streets_of(folder / "whole/city.glb"),
             again = streets_of(folder / "back/city.glb");
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].name, again[i].name);
    EXPECT_EQ(once[i].lines, again[i].lines);
  }
}

// A roof in Amsterdam, whose CRS is an oblique stereographic projection on an ellipsoid of its own.
TEST(BakePlaces, ACityInAnotherCrsHasTheLatitudesThatProjSays) {
  const TempFolder folder;
  std::string city = test::city_model(test::member(
      "<bldg:Building gml:id=\"a\">" +
      test::boundary("RoofSurface",
                     test::surface_member(test::polygon(
                         "", "121000 487000 5 121050 487000 5 121050 487040 5 121000 487000 5"))) +
      "</bldg:Building>"));
  city.replace(city.find("EPSG:25833"), 10, "EPSG:28992");
  test::write_text(folder / "a.gml", city);
  for (const bool ground : {true, false}) {
    Recipe recipe;
    recipe.city.files = {folder / "a.gml"};
    recipe.windows.lit = false;
    recipe.terrain.make_surface = ground;
    bake(recipe, folder / "out");
    const Scene scene = read_scene(folder / "out/city.glb");
    EXPECT_TRUE(scene.places.streets.empty());
    ASSERT_TRUE(scene.places.geographic) << ground;
    const glm::dvec2 place(121025, 487010);
    const georeference::CityFrame frame =
        georeference::CityFrame::from_srs_name("EPSG:28992", {}, {});
    const glm::dvec2 truth = frame.to_lon_lat(place);
    const auto degrees = to_degrees(*scene.places.geographic, place);
    ASSERT_TRUE(degrees);
    EXPECT_NEAR(degrees->x, truth.y, 0.1 / 111'300);
    EXPECT_NEAR(degrees->y, truth.x, 0.1 / 67'900);
  }
}

TEST(BakePlaces, ACityWithoutACrsSaysThatItHasNone) {
  const TempFolder folder;
  std::string city = test::city_model(test::member(test::building("a")));
  test::write_text(folder / "a.gml", city);
  Recipe recipe;
  recipe.city.files = {folder / "a.gml"};
  recipe.city.frame.crs_override = "none";
  recipe.windows.lit = false;
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_FALSE(read_scene(folder / "out/city.glb").places.geographic);
  EXPECT_EQ(report.places.why_no_degrees, "the city names no CRS");
  EXPECT_NE(to_text(report).find("no latitude and longitude: the city names no CRS"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::bake
