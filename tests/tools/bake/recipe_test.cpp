#include <gtest/gtest.h>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/read_recipe_text.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/recipe/recipe.h"

namespace nightcity::bake {
namespace {

using test::read_recipe_text;
using test::TempFolder;

TEST(Recipe, TwoKeysSufficeAndPathsAreRelativeToIt) {
  const TempFolder folder;
  const Recipe recipe = read_recipe_text(
      folder, "[city]\nfiles = ['a.gml', 'sub/../b.gml']\n[osm]\nfiles = 'm.osm.pbf'\n");
  EXPECT_EQ(recipe.city.files,
            (std::vector<std::filesystem::path>{folder / "a.gml", folder / "b.gml"}));
  EXPECT_EQ(recipe.osm.files, (std::vector<std::filesystem::path>{folder / "m.osm.pbf"}));
  EXPECT_EQ(recipe.city.tile_m, 250);
  EXPECT_FALSE(recipe.output.draco);
  EXPECT_TRUE(recipe.output.hierarchies);
  EXPECT_NE(recipe.osm.licence.find("ODbL"), std::string::npos);
}

TEST(Recipe, TakesEveryOption) {
  const TempFolder folder;
  const Recipe recipe = read_recipe_text(folder, R"(
[city]
files = ["a.gml"]
crs = "EPSG:25833"
control_points = [[13.0, 52.0, 0, 0], [13.1, 52.1, 1000.5, 1000]]
lod = 1
reader = "libcitygml"
threads = 3
tile_m = 500
drop_ground = true
drop_hidden = true
licence = ["one", "two"]
[terrain]
dem = ["a.tif", "b.tif"]
make_surface = false
margin_m = 12.5
[origin]
easting = 1
northing = 2.5
height = -3
[windows]
lit = false
seed = 42
[lamps]
off = {service = "00:30-04:30"}
half_night = {residential = "23:00-05:00"}
luminaires = [{file = "s.ldt", roads = ["primary", "secondary"], types = ["led"], flux = false}, {file = "t.ies"}]
[night]
time = "01:30"
[output]
draco = true
draco_tolerance_m = 0.001
hierarchies = false
punctual = 50
)");
  EXPECT_EQ(recipe.city.frame.crs_override, "EPSG:25833");
  ASSERT_EQ(recipe.city.frame.control_points.size(), 2u);
  EXPECT_EQ(recipe.city.frame.control_points[1].model, glm::dvec2(1000.5, 1000));
  EXPECT_EQ(recipe.city.read.max_lod, 1);
  EXPECT_EQ(recipe.city.read.reader, city::Reader::libcitygml);
  EXPECT_EQ(recipe.city.read.threads, 3u);
  EXPECT_EQ(recipe.city.tile_m, 500);
  EXPECT_TRUE(recipe.city.drop_ground);
  EXPECT_TRUE(recipe.city.drop_hidden);
  EXPECT_EQ(recipe.city.licences, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(recipe.terrain.elevation_models,
            (std::vector<std::filesystem::path>{folder / "a.tif", folder / "b.tif"}));
  EXPECT_FALSE(recipe.terrain.make_surface);
  EXPECT_EQ(recipe.terrain.margin_m, 12.5);
  EXPECT_EQ(recipe.origin.easting, 1.0);
  EXPECT_EQ(recipe.origin.northing, 2.5);
  EXPECT_EQ(recipe.origin.height, -3.0);
  EXPECT_FALSE(recipe.windows.lit);
  EXPECT_EQ(recipe.windows.seed, 42u);
  EXPECT_EQ(recipe.night.minute, 8 * 60 + 30);
  EXPECT_EQ(recipe.lamps.hours.off.at("service").from, lights::minute_of(0, 30));
  EXPECT_EQ(recipe.lamps.hours.half_night.at("residential").to, lights::minute_of(5, 0));
  ASSERT_EQ(recipe.lamps.luminaires.size(), 2u);
  EXPECT_EQ(recipe.lamps.luminaires[0].file, folder / "s.ldt");
  EXPECT_EQ(recipe.lamps.luminaires[0].highways,
            (std::vector<std::string>{"primary", "secondary"}));
  EXPECT_EQ(recipe.lamps.luminaires[0].types, std::vector<lights::LampType>{lights::LampType::led});
  EXPECT_FALSE(recipe.lamps.luminaires[0].take_flux);
  EXPECT_TRUE(recipe.lamps.luminaires[1].highways.empty());
  EXPECT_TRUE(recipe.lamps.luminaires[1].take_flux);
  EXPECT_EQ(recipe.output.punctual, 50u);
  EXPECT_TRUE(recipe.output.draco);
  EXPECT_FALSE(recipe.output.hierarchies);
  EXPECT_EQ(recipe.output.draco_tolerance_m, 0.001);
}

TEST(Recipe, TrafficDrivesWhereItsTableIsThere) {
  const TempFolder folder;
  const std::string files = "[city]\nfiles = 'a.gml'\n";
  EXPECT_FALSE(read_recipe_text(folder, files).traffic.is_made);
  EXPECT_TRUE(read_recipe_text(folder, files + "[traffic]\n").traffic.is_made);
  EXPECT_FALSE(read_recipe_text(folder, files + "[traffic]\ndrives = false\n").traffic.is_made);
  const Recipe recipe = read_recipe_text(
      folder, files + "[traffic]\nper_km = 2.5\ncycle_s = 300\nside = 'left'\nseed = 4\n");
  EXPECT_EQ(recipe.traffic.options.per_km, 2.5);
  EXPECT_EQ(recipe.traffic.options.cycle_s, 300);
  EXPECT_EQ(recipe.traffic.options.side, traffic::Side::left);
  EXPECT_EQ(recipe.traffic.options.seed, 4u);
  for (const char* wrong :
       {"side = 'up'", "cycle_s = 5", "vehicles = -1", "hours = [1.0]", "speed = 3"})
    EXPECT_THROW(read_recipe_text(folder, files + "[traffic]\n" + wrong + "\n"), UsageError)
        << wrong;
}

TEST(Recipe, WrongValuesAreUsageErrors) {
  const TempFolder folder;
  for (const char* line :
       {"lod = 5", "lod = 1.5", "lod = '2'", "tile_m = 0", "tile_m = inf", "tile_m = nan",
        "crs = 25833", "reader = 'sax'", "threads = -1", "licence = [1]",
        "control_points = [[1, 2, 3, 4]]", "control_points = [[1, 2, 3], [1, 2, 3]]",
        "files = ['']", "unknown = 1", "bounds = [1, 2, 3]", "bounds = [13.1, 52, 13, 52.1]",
        "bounds = [13, 52, 13.1, 91]",
        "bounds = [13, 52, 14, 53]\ncontrol_points = [[13, 52, 0, 0], [14, 53, 1, 1]]"})
    EXPECT_THROW(read_recipe_text(folder, std::string("[city]\nfiles = ['a.gml']\n") + line + "\n"),
                 Error)
        << line;
  EXPECT_THROW(read_recipe_text(folder, "[city]\nfiles = ['a.gml']\n[output]\ndraco = 1\n"),
               UsageError);
  EXPECT_THROW(read_recipe_text(folder, "city = 3\n"), UsageError);
  for (const char* line : {"off = '23:00-05:00'", "off = {residential = '05:00-23:00'}",
                           "off = {raceway = '23:00-05:00'}", "half_night = {residential = 23}",
                           "luminaires = 's.ldt'", "luminaires = [{roads = ['primary']}]",
                           "luminaires = [{file = 's.ldt', roads = ['raceway']}]",
                           "luminaires = [{file = 's.ldt', types = ['?']}]",
                           "luminaires = [{file = 's.ldt', colour = 3000}]"})
    EXPECT_THROW(
        read_recipe_text(folder, std::string("[city]\nfiles = ['a.gml']\n[lamps]\n") + line + "\n"),
        UsageError)
        << line;
  for (const char* time : {"12:00", "07:00", "24:00", "22:60", "22", "2200", "aa:bb"})
    EXPECT_THROW(
        read_recipe_text(
            folder, std::string("[city]\nfiles = ['a.gml']\n[night]\ntime = '") + time + "'\n"),
        UsageError);
  EXPECT_THROW(read_recipe_text(folder, "[traffic]\n"), UsageError);
  // A map alone suffices for lamps and traffic; a bake needs the city.
  EXPECT_TRUE(read_recipe_text(folder, "[osm]\nfiles = ['a.osm']\n").city.files.empty());
  EXPECT_THROW(
      CityFrames(to_bake_options(read_recipe_text(folder, "[osm]\nfiles = ['a.osm']\n")).city),
      UsageError);
}

TEST(Recipe, ATextWithAZeroByteIsRefusedByItsLine) {
  const TempFolder folder;
  for (const char* line : {"files = [\"a.gml\", \"b\\u0000c.gml\"]", "files = \"\\u0000\"",
                           "files = 'a.gml'\nlicence = \"\\u0000\""}) {
    try {
      read_recipe_text(folder, std::string("[city]\n") + line);
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("zero byte"), std::string::npos) << message;
      EXPECT_NE(message.find("recipe.toml:"), std::string::npos) << message;
    }
  }
}

TEST(Recipe, KeysOfManyPartsAreRefusedBeforeTheyExhaustTheStack) {
  const TempFolder folder;
  std::string deep = "a";
  for (int i = 0; i < 200'000; ++i) deep += i % 2 ? ".a" : " . \"=\"";
  for (const std::string& text :
       {deep + " = 1", "[" + deep + "]", "a = {" + deep + " = 1}",
        "x = \"\"\" ' \" \"\"\"\n# \" '\n" + deep + " = 1", "x = '\\'\n" + deep + " = 1"}) {
    try {
      read_recipe_text(folder, text);
      ADD_FAILURE() << text.substr(0, 40);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("more than 32 parts"), std::string::npos)
          << error.what();
    }
  }
  const std::string dots(1000, '.');
  const Recipe recipe =
      read_recipe_text(folder, "# " + dots + "\n[city]\nfiles = ['" + dots + "', \"\"\"" + dots +
                                   ".\"\"\"]\n[origin]\nheight = 1.5\n");
  EXPECT_EQ(recipe.city.files.size(), 2u);
}

}  // namespace
}  // namespace nightcity::bake
