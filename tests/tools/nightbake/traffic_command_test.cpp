// Tests nightbake traffic and the table [traffic] from outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/light_file.h"
#include "formats/scene_reader.h"
#include "support/process.h"
#include "support/temp_folder.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;
using test::Outcome;
using test::quoted;
using test::TempFolder;
using test::write_text;

/// Writes a town of few blocks; `traffic` replaces the table [traffic] of its recipe.
std::filesystem::path small_town(const TempFolder& folder, const std::string& traffic) {
  const auto path = folder.path() / "town";
  EXPECT_EQ(
      test::run_program("nightbake", "town --blocks 9 --out '" + path.string() + "'").exit_code, 0);
  write_text(
      path / "town.toml",
      "[city]\nfiles = [\"town.gml\"]\n[osm]\nfiles = [\"town.osm\"]\n[windows]\nlit = false\n" +
          traffic);
  return path / "town.toml";
}

TEST(TrafficCommand, WritesDrivesThatInspectShows) {
  const TempFolder folder;
  const auto recipe = small_town(folder, "[traffic]\nvehicles = 8\ncycle_s = 240\n");
  const auto out = folder.path() / "traffic.lights";
  const Outcome outcome =
      test::run_program("nightbake", "traffic" + quoted(recipe) + "--json --out" + quoted(out));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_GT(report["trips"], 5);
  EXPECT_EQ(report["side"], "right");
  const LightFile file = LightFile::open(out);
  file.verify();
  EXPECT_EQ(file.traffic().trips.size(), report["trips"]);
  const json shown =
      json::parse(test::run_program("nightbake", "inspect --json" + quoted(out)).out);
  EXPECT_EQ(shown["traffic"]["trips"], report["trips"]);
  EXPECT_EQ(shown["traffic"]["cycle_s"], 240);
  EXPECT_NEAR(shown["traffic"]["vehicles_by_hour_from_noon"][5].get<double>(),
              report["vehicles_on_the_road"].get<double>(), 1e-3);
}

TEST(TrafficCommand, ReplacesTheTrafficOfALightFileAndKeepsItsLights) {
  const TempFolder folder;
  const auto recipe = small_town(folder, "[traffic]\nvehicles = 8\ncycle_s = 240\n");
  const auto baked = folder.path() / "baked";
  ASSERT_EQ(
      test::run_program("nightbake", "run" + quoted(recipe) + "--out" + quoted(baked)).exit_code,
      0);
  const auto lights = baked / "city.lights";
  std::size_t lamps, profiles;
  uint first_trip;
  {
    const LightFile file = LightFile::open(lights);
    file.verify();
    lamps = file.lights().size();
    profiles = file.profiles().size();
    ASSERT_FALSE(file.traffic().trips.empty());
    first_trip = file.traffic().trips.front().id;
    // The scene has the bodies: one node for each kind of vehicle.
    std::size_t bodies = 0;
    for (const SceneNode& node : read_scene(baked / "city.glb").nodes)
      if (node.kind == "vehicle") {
        ++bodies;
        EXPECT_LT(node.vehicle, file.traffic().vehicles.size());
        EXPECT_TRUE(node.casts_shadow);
      }
    EXPECT_GE(bodies, 2u);
  }
  write_text(recipe,
             "[city]\nfiles = [\"town.gml\"]\n[osm]\nfiles = [\"town.osm\"]\n"
             "[traffic]\nvehicles = 4\nseed = 9\nside = \"left\"\n");
  const Outcome outcome =
      test::run_program("nightbake", "traffic" + quoted(recipe) + "--lights" + quoted(lights) +
                                         "--out" + quoted(lights));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("on the left"), std::string::npos);
  const LightFile file = LightFile::open(lights);
  file.verify();
  EXPECT_EQ(file.lights().size(), lamps);
  EXPECT_NE(file.traffic().trips.front().id, first_trip);
  EXPECT_LE(file.profiles().size(), profiles + 2);
}

TEST(TrafficCommand, TheModelsOwnRoadsAreStreetsWhereThereIsNoMap) {
  const TempFolder folder;
  const auto recipe = small_town(folder, "[traffic]\nvehicles = 8\ncycle_s = 240\n");
  const auto out = folder.path() / "traffic.lights";
  const auto report_of = [&] {
    const Outcome outcome =
        test::run_program("nightbake", "traffic" + quoted(recipe) + "--json --out" + quoted(out));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out);
  };
  const json with_map = report_of();
  write_text(recipe, "[city]\nfiles = [\"town.gml\"]\n[traffic]\nvehicles = 8\ncycle_s = 240\n");
  const json without = report_of();
  EXPECT_EQ(with_map["streets"]["surfaces"], 0);
  EXPECT_GT(without["streets"]["surfaces"], 20);
  EXPECT_GT(without["trips"], 5);
  // The same town: as many junctions within a third, since the map's paths and alleys are no
  // carriageways.
  EXPECT_GT(without["edges"].get<double>(), 0.5 * with_map["edges"].get<double>());
  EXPECT_LT(without["edges"].get<double>(), 1.5 * with_map["edges"].get<double>());
}

TEST(TrafficCommand, AMapAloneIsDrivenOnAPlane) {
  const TempFolder folder;
  const auto town = small_town(folder, "").parent_path();
  const auto out = folder.path() / "traffic.lights";
  const Outcome outcome =
      test::run_program("nightbake", "traffic" + quoted(town / "town.osm") +
                                         "--vehicles 6 --json --out" + quoted(out));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(json::parse(outcome.out)["trips"], 5);
  const LightFile file = LightFile::open(out);
  EXPECT_EQ(file.georeference().crs, "EPSG:32633");
  for (const TripKnot& knot : file.traffic().knots) EXPECT_EQ(knot.position.y, 0);
}

TEST(TrafficCommand, SaysWhatIsWrong) {
  const TempFolder folder;
  const auto recipe = small_town(folder, "[traffic]\nside = \"middle\"\n");
  const Outcome side =
      test::run_program("nightbake", "traffic" + quoted(recipe) + "--out x.lights");
  EXPECT_EQ(side.exit_code, 2);
  EXPECT_NE(side.err.find("side"), std::string::npos);
  write_text(
      recipe,
      "[city]\nfiles = [\"town.gml\"]\n[osm]\nfiles = [\"town.osm\"]\n[traffic]\nhours = [1, 2]\n");
  EXPECT_EQ(test::run_program("nightbake", "traffic" + quoted(recipe) + "--out x.lights").exit_code,
            2);
  write_text(recipe, "[traffic]\n");
  const Outcome nothing =
      test::run_program("nightbake", "traffic" + quoted(recipe) + "--out x.lights");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.err.find("city"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::nightbake
