// Tracks, parking bays and crossings of the map through a whole bake: on the ground of the scene,
// whatever the number of parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/vec2.hpp>
#include <string>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

// Writes a map without a city model: six houses, a tram of two gauges, a railway in a tunnel, a
// street with bays and a crossing. Returns the recipe, which ends in `more`.
fs::path write_map_with_rails(const fs::path& folder, const std::string& more = {}) {
  std::ofstream map(folder / "rails.osm");
  map << "<osm version='0.6'>\n";
  int nodes = 0, ways = 0;
  const auto add_node = [&](const glm::dvec2& metres, const std::string& tags = {}) {
    char place[80];
    std::snprintf(place, sizeof place, "lon='%.7f' lat='%.7f'", 13.4 + metres.x / 67'900,
                  52.5 + metres.y / 111'300);
    map << "<node id='" << ++nodes << "' " << place << ">" << tags << "</node>\n";
  };
  // A way along the nodes that were written last.
  const auto add_way = [&](int count, bool closed, const std::string& tags) {
    map << "<way id='" << ++ways << "'>";
    for (int n = nodes - count + 1; n <= nodes; ++n) map << "<nd ref='" << n << "'/>";
    if (closed) map << "<nd ref='" << nodes - count + 1 << "'/>";
    map << tags << "</way>\n";
  };
  for (int n = 0; n < 6; ++n) {
    const glm::dvec2 corner(80 * (n % 3), 120 * (n / 3));
    for (const glm::dvec2& side : {glm::dvec2(0, 0), {10, 0}, {10, 10}, {0, 10}})
      add_node(corner + side);
    add_way(4, true, "<tag k='building' v='yes'/>");
  }
  const auto add_line = [&](double north, const std::string& tags) {
    add_node({0, north});
    add_node({90, north + 5}, "<tag k='highway' v='crossing'/><tag k='crossing' v='zebra'/>");
    add_node({180, north});
    add_way(3, false, tags);
  };
  add_line(30, "<tag k='railway' v='tram'/><tag k='gauge' v='1000;1435'/>");
  add_line(50, "<tag k='railway' v='rail'/><tag k='tunnel' v='yes'/>");
  add_line(80,
           "<tag k='highway' v='residential'/><tag k='parking:both' v='street_side'/>"
           "<tag k='parking:both:markings' v='yes'/>");
  map << "</osm>\n";
  std::ofstream(folder / "rails.toml") << "[osm]\nfiles = ['rails.osm']\n" << more;
  return folder / "rails.toml";
}

bool has_material(const fs::path& glb, const std::string& name) {
  const Scene scene = read_scene(glb);
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [&](const SceneMaterial& material) { return material.name == name; });
}

TEST(BakeRails, TheReportSaysWhatOfTheMapLiesOnTheGround) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_map_with_rails(folder.path())), folder / "out");
  const double line_m = 2 * std::hypot(90, 5);
  EXPECT_NEAR(report.cover.tracks_m.at("tram on ballast"), line_m, 1e-2 * line_m);
  EXPECT_NEAR(report.cover.left_out_m.at("tracks below ground"), line_m, 1e-2 * line_m);
  EXPECT_NEAR(report.cover.parking_m.at("street side, parallel"), 2 * line_m, 2e-2 * line_m);
  EXPECT_GT(report.cover.markings.at("line between parking bays"), 50u);
  EXPECT_EQ(report.cover.markings.at("bar of a crossing"), 6u) << "5.5 m between kerbs";
  // Three rails of two gauges, on a grid of a millimetre.
  EXPECT_NEAR(report.tiles.cover_m2.at("rail"), line_m * 3 * 0.072, line_m * 3 * 3e-3);
  EXPECT_TRUE(has_material(folder / "out/city.glb", "rail"));
}

TEST(BakeRails, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_map_with_rails(folder.path()), folder.path(), {3});
}

TEST(BakeRails, OneWordTurnsThemOff) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_map_with_rails(
                                     folder.path(), "[ground]\nrails = false\nparking = false\n")),
                                 folder / "off");
  EXPECT_TRUE(report.cover.tracks_m.empty());
  EXPECT_TRUE(report.cover.parking_m.empty());
  EXPECT_FALSE(report.cover.left_out_m.contains("tracks below ground"));
  EXPECT_FALSE(report.cover.markings.contains("line between parking bays"));
  EXPECT_FALSE(has_material(folder / "off/city.glb", "rail"));
}

}  // namespace
}  // namespace nightcity::bake
