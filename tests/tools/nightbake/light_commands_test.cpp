// Tests the commands for single stages of the lights: a file in, a file out.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/light_file.h"
#include "formats/scene_reader.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;
using test::nightbake;
using test::Outcome;
using test::quoted;
using test::TempFolder;
using test::write_text;

TEST(LampsCommand, PlacesTheMapsLampsOnACityAndWritesThem) {
  const TempFolder folder;
  test::write_sample(folder);
  const Outcome outcome =
      nightbake("lamps " + quoted(folder / "map.osm") + quoted(folder / "city.gml") + "--json -o " +
                quoted(folder / "lamps.lights"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_EQ(report["mapped"], 2);
  EXPECT_EQ(report["placed"], 1);
  EXPECT_EQ(report["dropped"]["outside the model"], 1);
  const LightFile file = LightFile::open(folder / "lamps.lights");
  file.verify();
  ASSERT_EQ(file.lights().size(), 1u);
  EXPECT_EQ(file.georeference().crs, "EPSG:25833");
  const double height = file.georeference().from_model(glm::dvec3(file.lights()[0].position)).z;
  EXPECT_GT(height, 37);
  EXPECT_LT(height, 50);
}

TEST(LampsCommand, WithoutACityLampsStandAtTheirTaggedHeight) {
  const TempFolder folder;
  write_text(folder / "map.osm", R"(<osm version="0.6">
<node id="1" lat="52.5103" lon="13.3941"><tag k="highway" v="street_lamp"/><tag k="ele" v="35.5"/><tag k="height" v="6"/></node>
<node id="2" lat="52.5104" lon="13.3941"><tag k="highway" v="street_lamp"/><tag k="height" v="6"/></node>
</osm>)");
  ASSERT_EQ(nightbake("lamps " + quoted(folder / "map.osm") + "-o " + quoted(folder / "l.lights"))
                .exit_code,
            0);
  const LightFile file = LightFile::open(folder / "l.lights");
  ASSERT_EQ(file.lights().size(), 2u);
  EXPECT_EQ(file.georeference().crs, "EPSG:32633");
  EXPECT_NEAR(file.lights()[0].position.y, 41.5, 1e-3);
  EXPECT_NEAR(file.lights()[1].position.y, 6, 1e-3);
}

TEST(LampsCommand, SaysHowManyNodesHaveNoPlace) {
  const TempFolder folder;
  write_text(folder / "map.osm", R"(<osm version="0.6">
<node id="1" lat="52.5103" lon="13.3941"><tag k="highway" v="street_lamp"/></node>
<node id="2" lat="91" lon="13.3941"><tag k="highway" v="street_lamp"/></node>
<node id="3" lat="52,5" lon="13,4"><tag k="highway" v="street_lamp"/></node>
<node id="4"><tag k="highway" v="street_lamp"/></node>
<relation id="5"><member type="node" ref="9" role=""/><tag k="highway" v="street_lamp"/></relation>
</osm>)");
  const Outcome outcome = nightbake("lamps " + quoted(folder / "map.osm") + "--json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["placed"], 1);
  EXPECT_NE(outcome.err.find("map.osm: 3 nodes left out: their coordinates"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("map.osm: 1 lamps left out: they are relations"), std::string::npos)
      << outcome.err;
}

TEST(LampsCommand, ItsOsmFileReadsBackAsTheSameLamps) {
  const TempFolder folder;
  test::write_sample(folder);
  const std::string city = quoted(folder / "city.gml");
  ASSERT_EQ(
      nightbake("lamps " + quoted(folder / "map.osm") + city + "-o " + quoted(folder / "l.osm"))
          .exit_code,
      0);
  const Outcome again = nightbake("lamps --json " + quoted(folder / "l.osm") + city);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const json report = json::parse(again.out);
  EXPECT_EQ(report["placed"], 1);
  EXPECT_EQ(report["sources"]["flux"]["tag"], 1);
  EXPECT_EQ(report["sources"]["height"]["tag"], 1);
}

TEST(LampsCommand, WrongUseIsToldApartFromBrokenData) {
  const TempFolder folder;
  test::write_sample(folder);
  EXPECT_EQ(nightbake("lamps " + quoted(folder / "city.gml")).exit_code, 2);
  EXPECT_EQ(
      nightbake("lamps " + quoted(folder / "map.osm") + "-o " + quoted(folder / "l.txt")).exit_code,
      2);
  EXPECT_EQ(
      nightbake("lamps " + quoted(folder / "recipe.toml") + quoted(folder / "map.osm")).exit_code,
      2);
  EXPECT_EQ(nightbake("lamps " + quoted(folder / "absent.osm")).exit_code, 1);
  EXPECT_EQ(nightbake("windows " + quoted(folder / "map.osm") + "-o " + quoted(folder / "w.lights"))
                .exit_code,
            2);
  EXPECT_FALSE(std::filesystem::exists(folder / "w.lights"));
}

TEST(WindowsCommand, LaysWindowsWithTheirHours) {
  const TempFolder folder;
  test::write_sample(folder);
  const Outcome outcome = nightbake("windows " + quoted(folder / "city.gml") +
                                    "--json --seed 3 -o " + quoted(folder / "w.lights"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  const LightFile file = LightFile::open(folder / "w.lights");
  file.verify();
  ASSERT_GT(file.lights().size(), 5u);
  EXPECT_EQ(report["placed"], file.lights().size());
  EXPECT_EQ(report["schedules"], file.schedules().size());
  EXPECT_EQ(report["by_use"]["residential"]["placed"], file.lights().size());
  for (const Light& light : file.lights()) {
    ASSERT_LT(light.schedule, file.schedules().size());
    EXPECT_EQ(light_kind(light), LightKind::rectangle);
    const Schedule& schedule = file.schedules()[light.schedule];
    EXPECT_GE(schedule.count, 2u);
    EXPECT_GE(file.switches()[schedule.first], 18'000u);                       // 17:00
    EXPECT_LE(file.switches()[schedule.first + schedule.count - 1], 68'400u);  // 07:00
  }
  // The same windows as a bake with that seed has.
  write_text(folder / "r.toml", "[city]\nfiles = [\"city.gml\"]\n[windows]\nseed = 3\n");
  ASSERT_EQ(
      nightbake("run " + quoted(folder / "r.toml") + "-o " + quoted(folder / "out")).exit_code, 0);
  const LightFile baked = LightFile::open(folder / "out/city.lights");
  ASSERT_EQ(baked.lights().size(), file.lights().size());
  for (std::size_t n = 0; n < baked.lights().size(); ++n)
    EXPECT_EQ(baked.lights()[n].id, file.lights()[n].id);
}

TEST(LightsCommand, SumsUpKindsLumensHoursAndSources) {
  const TempFolder folder;
  ASSERT_EQ(nightbake("run " + quoted(test::write_sample(folder)) + "-o " + quoted(folder / "out"))
                .exit_code,
            0);
  const Outcome outcome = nightbake("lights --report " + quoted(folder / "out/city.lights") +
                                    "--scene " + quoted(folder / "out/city.glb") + "--json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  const LightFile file = LightFile::open(folder / "out/city.lights");
  double flux = 0;
  std::size_t count = 0;
  for (const auto& [name, family] : report["families"].items()) {
    count += family["count"].get<std::size_t>();
    flux += family["flux_lm"].get<double>();
    for (const auto& [value, sources] : family["sources"].items()) {
      std::size_t sum = 0;
      for (const auto& [source, n] : sources.items()) sum += n.get<std::size_t>();
      EXPECT_EQ(sum, family["count"]) << name << " " << value;
    }
  }
  double expected = 0;
  for (const Light& light : file.lights()) expected += double{light.flux_lm};
  EXPECT_EQ(count, file.lights().size());
  EXPECT_NEAR(flux, expected, 1e-6 * expected);
  EXPECT_EQ(report["families"]["lamp"]["always_on"], report["families"]["lamp"]["count"]);
  EXPECT_EQ(report["families"]["window"]["always_on"], 0);
  EXPECT_TRUE(report["faults"].empty()) << report["faults"];
  EXPECT_EQ(nightbake("lights " + quoted(folder / "out/city.lights")).exit_code, 0);
  EXPECT_EQ(nightbake("lights " + quoted(folder / "map.osm")).exit_code, 1);
}

TEST(LightsCommand, CountsLightsThatAreWhereNoneMayBe) {
  const TempFolder folder;
  ASSERT_EQ(nightbake("run " + quoted(test::write_sample(folder)) + "-o " + quoted(folder / "out"))
                .exit_code,
            0);
  const LightFile file = LightFile::open(folder / "out/city.lights");
  const Georeference& geo = file.georeference();
  std::vector<Light> lights(file.lights().begin(), file.lights().end());
  std::vector<LightProvenance> provenance(file.provenance().begin(), file.provenance().end());
  lights[0].position = glm::vec3(geo.to_model({391005, 5819005, 40}));  // amid the cube
  lights[1].position = glm::vec3(geo.to_model({391030, 5819020, 34}));  // a metre under the terrain
  LightFileContent content;
  content.georeference = geo;
  content.lights = lights;
  content.provenance = provenance;
  content.profiles = file.profiles();
  content.profile_data = file.profile_data();
  content.schedules = file.schedules();
  content.switches = file.switches();
  write_light_file(folder / "moved.lights", content);
  const json report = json::parse(nightbake("lights --json " + quoted(folder / "moved.lights") +
                                            "--scene " + quoted(folder / "out/city.glb"))
                                      .out);
  EXPECT_EQ(report["faults"]["inside a building"], 1);
  EXPECT_EQ(report["faults"]["below the ground"], 1);
}

TEST(ElevateCommand, WritesTheModelsHeightsIntoTheMap) {
  const TempFolder folder;
  test::write_sample(folder);
  const Outcome outcome =
      nightbake("elevate " + quoted(folder / "map.osm") + quoted(folder / "city.gml") +
                "--json -o " + quoted(folder / "high.osm"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_EQ(report["lamps"], 2);
  EXPECT_EQ(report["sources"]["terrain"], 1);
  EXPECT_EQ(report["outside_model"], 1);
  EXPECT_EQ(report["written"], 1);
  const std::string text = test::read_text(folder / "high.osm");
  EXPECT_NE(text.find("k=\"ele\" v=\"35.00\""), std::string::npos) << text;
  EXPECT_EQ(nightbake("elevate " + quoted(folder / "map.osm")).exit_code, 2);
  EXPECT_EQ(nightbake("elevate " + quoted(folder / "city.gml")).exit_code, 2);
  EXPECT_EQ(
      nightbake("elevate " + quoted(folder / "map.osm") + "--dem " + quoted(folder / "city.gml"))
          .exit_code,
      1);
}

// A table of heights names no CRS.
TEST(ElevateCommand, TheCrsOfARasterIsSaidOnTheCommandLine) {
  const TempFolder folder;
  write_text(folder / "map.osm",
             "<osm version=\"0.6\"><node id=\"1\" lat=\"52.510303463\" lon=\"13.394162598\">"
             "<tag k=\"highway\" v=\"street_lamp\"/></node></osm>");
  std::string rows;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      rows += std::to_string(391000 + 10 * x) + " " + std::to_string(5819000 + 10 * y) + " 37.5\n";
  write_text(folder / "dem.xyz", rows);
  const std::string command = "elevate " + quoted(folder / "map.osm") + "-o " +
                              quoted(folder / "high.osm") + "--dem " + quoted(folder / "dem.xyz");
  const Outcome without = nightbake(command);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.err.find("--dem-crs"), std::string::npos) << without.err;
  EXPECT_EQ(nightbake(command + "--dem-crs EPSG:1").exit_code, 1);
  const Outcome with = nightbake(command + "--dem-crs EPSG:25833");
  ASSERT_EQ(with.exit_code, 0) << with.err;
  EXPECT_NE(test::read_text(folder / "high.osm").find("k=\"ele\" v=\"37.50\""), std::string::npos);
  EXPECT_EQ(nightbake("elevate " + quoted(folder / "map.osm") + "--dem-crs EPSG:25833").exit_code,
            2);
}

TEST(InspectCommand, TellsALuminairesFluxAndPeak) {
  const TempFolder folder;
  // Lambertian to 90 degrees: 1000 cd straight down are 1000 pi lumens of a dense grid.
  std::string text =
      "IESNA:LM-63-2002\n[LUMINAIRE] test\nTILT=NONE\n1 -1 1 91 1 1 2 0 0 0\n1 1 100\n";
  for (int n = 0; n <= 90; ++n) text += std::to_string(n) + (n % 10 == 9 ? "\n" : " ");
  text += "\n0\n";
  for (int n = 0; n <= 90; ++n)
    text +=
        std::to_string(1000 * std::cos(n * 3.14159265358979 / 180)) + (n % 10 == 9 ? "\n" : " ");
  write_text(folder / "lambert.ies", text + "\n");
  const Outcome outcome = nightbake("inspect --json " + quoted(folder / "lambert.ies"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json holds = json::parse(outcome.out);
  EXPECT_EQ(holds["kind"], "luminaire");
  EXPECT_NEAR(holds["flux_lm"].get<double>(), 3141.6, 3141.6 * 0.005);
  EXPECT_NEAR(holds["resampled_flux_lm"].get<double>(), 3141.6, 3141.6 * 0.005);
  EXPECT_NEAR(holds["peak_cd"].get<double>(), 1000, 1);
  write_text(folder / "broken.ies", text.substr(0, text.size() / 2));
  const Outcome broken = nightbake("inspect " + quoted(folder / "broken.ies"));
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_NE(broken.err.find("broken.ies:"), std::string::npos) << broken.err;
}

TEST(PunctualLights, TheRecipesBrightestAreInTheSceneAndOursReadItAllTheSame) {
  const TempFolder folder;
  test::write_sample(folder);
  const std::string inputs = "[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"map.osm\"]\n";
  write_text(folder / "p.toml", inputs + "[output]\npunctual = 2\n");
  ASSERT_EQ(nightbake("run " + quoted(folder / "p.toml") + "-o " + quoted(folder / "p")).exit_code,
            0);
  ASSERT_EQ(
      nightbake("run " + quoted(folder / "recipe.toml") + "-o " + quoted(folder / "n")).exit_code,
      0);
  const std::string with = test::read_text(folder / "p/city.glb"),
                    without = test::read_text(folder / "n/city.glb");
  EXPECT_EQ(without.find("KHR_lights_punctual"), std::string::npos);
  EXPECT_NE(with.find("KHR_lights_punctual"), std::string::npos);
  const std::size_t first = with.find('{');
  const json document =
      json::parse(with.substr(first, with.find("BIN", first) - 4 - first), nullptr, false);
  std::size_t placed = 0;
  if (!document.is_discarded())
    for (const json& node : document["nodes"])
      placed += node.contains("extensions") && node["extensions"].contains("KHR_lights_punctual");
  EXPECT_EQ(placed, 2u);
  EXPECT_EQ(read_scene(folder / "p/city.glb").nodes.size(),
            read_scene(folder / "n/city.glb").nodes.size());
}

}  // namespace
}  // namespace nightcity::nightbake
