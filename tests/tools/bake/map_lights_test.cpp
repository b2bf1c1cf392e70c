// Lights of the map that are no street lamps, through a whole bake: in both files, whatever the
// number of parts.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "formats/light_file.h"
#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/osm/read_osm.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

void write_node(std::ofstream& map, int id, const glm::dvec2& lon_lat, const char* tags = "") {
  char text[300];
  std::snprintf(text, sizeof text, "<node id='%d' lon='%.7f' lat='%.7f'>%s</node>\n", id, lon_lat.x,
                lon_lat.y, tags);
  map << text;
}

// Writes a town and a map of a poster box beside each of its first twenty lamps, and of a lit pitch
// whose outline is a relation. Returns the recipe, which ends in `more`.
fs::path write_town_with_signs(const fs::path& folder, const std::string& more = {}) {
  town::TownOptions options;
  options.columns = options.rows = 2;
  town::write_town(options, folder);
  const osm::OsmData town = osm::read_osm(folder / "town.osm");
  std::ofstream map(folder / "signs.osm");
  map << "<osm version='0.6'>\n";
  for (int n = 0; n < 20; ++n)
    write_node(map, 900'001 + n, town.lamps.at(static_cast<std::size_t>(n)).lon_lat + 1e-5,
               "<tag k='advertising' v='poster_box'/>");
  const glm::dvec2 middle = town.lamps.at(town.lamps.size() / 2).lon_lat;
  const glm::dvec2 corners[] = {{-4e-4, -2e-4}, {4e-4, -2e-4}, {4e-4, 2e-4}, {-4e-4, 2e-4}};
  for (int n = 0; n < 4; ++n) write_node(map, 910'000 + n, middle + corners[n]);
  map << "<way id='920001'><nd ref='910000'/><nd ref='910001'/><nd ref='910002'/></way>"
         "<way id='920002'><nd ref='910002'/><nd ref='910003'/><nd ref='910000'/></way>"
         "<relation id='930001'><member type='way' ref='920001' role='outer'/>"
         "<member type='way' ref='920002' role='outer'/><tag k='type' v='multipolygon'/>"
         "<tag k='leisure' v='pitch'/><tag k='lit' v='yes'/></relation></osm>\n";
  std::ofstream(folder / "signs.toml") << "[city]\nfiles = ['town.gml']\n"
                                          "[osm]\nfiles = ['town.osm', 'signs.osm']\n"
                                       << more;
  return folder / "signs.toml";
}

TEST(BakeMapLights, BothFilesHaveThemAndTheirFacesNameTheirLights) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_town_with_signs(folder.path())), folder / "out");
  const map_lights::MapLightReport& others = report.lights.map_lights;
  EXPECT_EQ(others.kinds[0].mapped, 20u);
  EXPECT_EQ(others.kinds[2].mapped, 1u);
  ASSERT_GT(others.kinds[0].lit, 0u);

  const LightFile lights = LightFile::open(folder / "out/city.lights");
  lights.verify();
  std::size_t count = 0;
  double flux = 0;
  std::set<std::uint32_t> rectangles, ids;
  for (std::size_t n = 0; n < lights.lights().size(); ++n) {
    ids.insert(lights.lights()[n].id);
    if (lights.provenance()[n].family != static_cast<std::uint8_t>(LightFamily::other)) continue;
    ++count;
    flux += double{lights.lights()[n].flux_lm};
    if (light_kind(lights.lights()[n]) == LightKind::rectangle)
      rectangles.insert(static_cast<std::uint32_t>(n));
  }
  EXPECT_EQ(count, others.kinds[0].lights + others.kinds[2].lights);
  EXPECT_NEAR(flux, others.kinds[0].flux_lm + others.kinds[2].flux_lm, 1e-4 * flux);

  const Scene scene = read_scene(folder / "out/city.glb");
  std::set<std::uint32_t> named;
  for (const SceneNode& node : scene.nodes)
    if (node.kind == "sign")
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        named.insert(primitive.light_ids.begin(), primitive.light_ids.end());
  named.erase(no_id);
  EXPECT_EQ(named, rectangles);
}

TEST(BakeMapLights, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_town_with_signs(folder.path()), folder.path(), {3});
}

TEST(BakeMapLights, OneWordTurnsThemOffAndLeavesTheOtherLightsAsTheyWere) {
  const TempFolder folder;
  bake(read_recipe(write_town_with_signs(folder.path(), "[map_lights]\nlit = false\n")),
       folder / "off");
  std::ofstream(folder / "plain.toml") << "[city]\nfiles = ['town.gml']\n"
                                          "[osm]\nfiles = ['town.osm']\n";
  bake(read_recipe(folder / "plain.toml"), folder / "plain");
  const LightFile off = LightFile::open(folder / "off/city.lights"),
                  plain = LightFile::open(folder / "plain/city.lights");
  ASSERT_EQ(off.lights().size(), plain.lights().size());
  for (std::size_t n = 0; n < off.lights().size(); ++n)
    EXPECT_EQ(off.lights()[n].id, plain.lights()[n].id);
}

}  // namespace
}  // namespace nightcity::bake
