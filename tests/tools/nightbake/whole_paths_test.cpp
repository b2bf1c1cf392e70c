// Commands one after the other, as someone with a folder of downloads gives them.
#include <gtest/gtest.h>

#include <string>

#include "support/process.h"
#include "support/temp_folder.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

using test::nightbake;
using test::Outcome;
using test::TempFolder;
using test::write_text;

std::string quote(const std::filesystem::path& path) {
  return "'" + path.string() + "'";
}

void expect_refusal(const Outcome& outcome, int exit_code, const std::string& what) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
}

// A house and a lamp on ground of 42 m.
constexpr const char* map_of_a_house =
    "<osm version='0.6'><node id='1' lat='52.51' lon='13.394'/><node id='2' lat='52.51' "
    "lon='13.3942'/><node id='3' lat='52.5102' lon='13.3942'/><node id='4' lat='52.5103' "
    "lon='13.394'><tag k='highway' v='street_lamp'/></node><way id='1'><nd ref='1'/><nd ref='2'/>"
    "<nd ref='3'/><nd ref='1'/><tag k='building' v='house'/></way></osm>";

// Heights of 42 m, 1.1 km to each side.
std::string grid_of_42_m() {
  std::string text = "ncols 20\nnrows 20\nxllcorner 13.384\nyllcorner 52.5\ncellsize 0.001\n";
  for (int i = 0; i < 400; ++i) text += "42 ";
  return text + "\n";
}

TEST(WholePaths, CommandsStandOnTheElevationModelThatARecipeLaysUnderAMap) {
  const TempFolder folder;
  write_text(folder / "map.osm", map_of_a_house);
  write_text(folder / "dgm.asc", grid_of_42_m());
  write_text(folder / "r.toml",
             "[osm]\nfiles = 'map.osm'\n[terrain]\ndem = 'dgm.asc'\ndem_crs = 'EPSG:4326'\n");
  const std::string recipe = quote(folder / "r.toml");
  const Outcome lamps = nightbake("lamps " + recipe + " -o " + quote(folder / "l.osm"));
  ASSERT_EQ(lamps.exit_code, 0) << lamps.err;
  EXPECT_NE(test::read_text(folder / "l.osm").find("k=\"ele\" v=\"42.00\""), std::string::npos)
      << test::read_text(folder / "l.osm");
  const Outcome windows = nightbake("windows " + recipe + " -o " + quote(folder / "w.lights"));
  EXPECT_EQ(windows.exit_code, 0) << windows.err;
}

TEST(WholePaths, NoInputIsOverwrittenByItsLamps) {
  const TempFolder folder;
  write_text(folder / "map.osm", map_of_a_house);
  const std::string map = quote(folder / "map.osm");
  expect_refusal(nightbake("lamps " + map + " -o " + map), 2, "is one of the inputs");
  EXPECT_EQ(test::read_text(folder / "map.osm"), map_of_a_house);
}

TEST(WholePaths, ArgumentsOfOtherKindsAreNamed) {
  const TempFolder folder;
  test::write_sample(folder);
  const std::string model = quote(folder / "city.gml"), out = quote(folder / "out");
  expect_refusal(nightbake("export " + model + " -o " + out), 1, "city.gml: is no scene");
  expect_refusal(nightbake("new " + model + " " + model), 2, "city.gml: is a file");
  EXPECT_EQ(test::read_text(folder / "city.gml"), test::sample_gml());
}

TEST(WholePaths, PartsWhoseRecipeIsGoneAskForIt) {
  const TempFolder folder;
  const std::filesystem::path recipe = test::write_sample(folder);
  const Outcome part =
      nightbake("run " + quote(recipe) + " --part 1/1 -o " + quote(folder / "out"));
  ASSERT_EQ(part.exit_code, 0) << part.err;
  std::filesystem::rename(recipe, folder / "other.toml");
  const std::string merge = "merge " + quote(folder / "out/parts") + " -o " + quote(folder / "out");
  expect_refusal(nightbake(merge), 1, "--recipe");
  EXPECT_EQ(nightbake(merge + " --recipe " + quote(folder / "other.toml")).exit_code, 0);
}

}  // namespace
}  // namespace nightcity::nightbake
