// Tracks, parking bays and crossings of the map through a whole bake: on the ground of the scene,
// whatever the number of parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/osm/read_osm.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

// Writes a town and a map of a tram, a railway in a tunnel and a street with bays and a crossing
// between its lamps. Returns the recipe, which ends in `more`.
fs::path write_town_with_rails(const fs::path& folder, const std::string& more = {}) {
  town::TownOptions options;
  options.columns = options.rows = 2;
  town::write_town(options, folder);
  const osm::OsmData town = osm::read_osm(folder / "town.osm");
  std::ofstream map(folder / "rails.osm");
  map << "<osm version='0.6'>\n";
  for (int n = 0; n < 3; ++n) {
    const glm::dvec2 p = town.lamps.at(static_cast<std::size_t>(5 * n)).lon_lat;
    for (int i = 0; i < 3; ++i) {
      char text[200];
      std::snprintf(
          text, sizeof text, "<node id='%d' lon='%.7f' lat='%.7f'>%s</node>\n", 900'001 + 3 * n + i,
          p.x + i * 5e-4, p.y + i * 3e-4,
          n == 2 && i == 1 ? "<tag k='highway' v='crossing'/><tag k='crossing' v='zebra'/>" : "");
      map << text;
    }
  }
  const char* tags[] = {"<tag k='railway' v='tram'/><tag k='gauge' v='1000;1435'/>",
                        "<tag k='railway' v='rail'/><tag k='tunnel' v='yes'/>",
                        "<tag k='highway' v='residential'/><tag k='parking:both' v='street_side'/>"
                        "<tag k='parking:both:markings' v='yes'/>"};
  for (int n = 0; n < 3; ++n) {
    map << "<way id='" << 950'001 + n << "'>";
    for (int i = 0; i < 3; ++i) map << "<nd ref='" << 900'001 + 3 * n + i << "'/>";
    map << tags[n] << "</way>\n";
  }
  map << "</osm>\n";
  std::ofstream(folder / "rails.toml") << "[city]\nfiles = ['town.gml']\n"
                                          "[osm]\nfiles = ['town.osm', 'rails.osm']\n"
                                       << more;
  return folder / "rails.toml";
}

bool has_material(const fs::path& glb, const std::string& name) {
  const Scene scene = read_scene(glb);
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [&](const SceneMaterial& material) { return material.name == name; });
}

TEST(BakeRails, TheReportSaysWhatOfTheMapLiesOnTheGround) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_town_with_rails(folder.path())), folder / "out");
  double tracks_m = 0;
  for (const auto& [name, m] : report.cover.tracks_m) tracks_m += m;
  EXPECT_GT(tracks_m, 50);
  EXPECT_GT(report.cover.left_out_m.at("tracks below ground"), 10);
  EXPECT_GT(report.cover.parking_m.at("street side, parallel"), 20);
  EXPECT_GT(report.cover.markings.at("line between parking bays"), 0u);
  EXPECT_GT(report.cover.markings.at("bar of a crossing"), 0u);
  // Three rails of two gauges, on a grid of a millimetre.
  EXPECT_NEAR(report.tiles.cover_m2.at("rail"), tracks_m * 3 * 0.072, tracks_m * 3 * 3e-3);
  EXPECT_TRUE(has_material(folder / "out/city.glb", "rail"));
}

TEST(BakeRails, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_town_with_rails(folder.path()), folder.path(), {3});
}

TEST(BakeRails, OneWordTurnsThemOff) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_town_with_rails(
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
