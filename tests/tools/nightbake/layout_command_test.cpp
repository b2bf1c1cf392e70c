// Tests nightbake layout from outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/light_file.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;
using test::Outcome;
using test::TempFolder;
using test::write_text;

/// Writes the sample city with a map of one street and no lamp; `lamps` is the recipe's table
/// [lamps].
std::filesystem::path dark_sample(const TempFolder& folder, const std::string& lamps) {
  test::write_sample(folder);
  write_text(folder / "streets.osm", R"(<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6">
<node id="3" lat="52.5101" lon="13.39422"/><node id="4" lat="52.5105" lon="13.39422"/>
<way id="5"><nd ref="3"/><nd ref="4"/><tag k="highway" v="residential"/><tag k="name" v="Straße"/></way>
</osm>
)");
  write_text(folder / "recipe.toml",
             "[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"streets.osm\"]\n[lamps]\n" + lamps);
  return folder / "recipe.toml";
}

Outcome lay_out(const std::filesystem::path& recipe, const std::string& more = "") {
  return test::run_program("nightbake", "layout '" + recipe.string() + "' " + more);
}

TEST(LayoutCommand, TellsWhatEachClassOfRoadGets) {
  const TempFolder folder;
  const Outcome outcome = lay_out(dark_sample(folder, ""), "--json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_GE(report["lamps"], 2);
  const json& row = report["classes"]["residential"];
  EXPECT_EQ(row["class"], "P4");
  EXPECT_GT(row["average_lx"], 5 / 0.8);
  EXPECT_LT(row["average_lx"], 7.5 / 0.8);
  EXPECT_FALSE(report.contains("streets"));
  const json verbose = json::parse(lay_out(folder / "recipe.toml", "--json --verbose").out);
  ASSERT_EQ(verbose["streets"].size(), 1u);
  EXPECT_EQ(verbose["streets"][0]["name"], "Straße");
  EXPECT_EQ(verbose["streets"][0]["ways"], json::array({5}));
  const Outcome table = lay_out(folder / "recipe.toml");
  EXPECT_NE(table.out.find("residential"), std::string::npos);
}

TEST(LayoutCommand, ARecipeNamesTheClassOfItsRoads) {
  const TempFolder folder;
  const json report =
      json::parse(lay_out(dark_sample(folder, "class = {residential = \"P2\"}\n"), "--json").out);
  EXPECT_EQ(report["classes"]["residential"]["class"], "P2");
  EXPECT_GT(report["classes"]["residential"]["average_lx"], 10 / 0.8);
}

TEST(LayoutCommand, WhatARecipeMayNotSayIsAUsageErrorWithItsLine) {
  const TempFolder folder;
  for (const char* lamps :
       {"layout = \"sometimes\"\n", "class = {residential = \"P9\"}\n",
        "class = {raceway = \"P4\"}\n", "class = \"P4\"\n", "class = {residential = 4}\n"}) {
    const Outcome outcome = lay_out(dark_sample(folder, lamps));
    EXPECT_EQ(outcome.exit_code, 2) << lamps << outcome.err;
    EXPECT_NE(outcome.err.find(":6: "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(LayoutCommand, ItsOsmFileBakesToTheSameLampsAsTheLayoutItself) {
  const TempFolder folder;
  const std::filesystem::path recipe = dark_sample(folder, "");
  ASSERT_EQ(lay_out(recipe, "--out '" + (folder / "lamps.osm").string() + "'").exit_code, 0);
  const auto bake = [&](const char* out) {
    const Outcome outcome = test::run_program(
        "nightbake", "run '" + recipe.string() + "' --out '" + (folder / out).string() + "'");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return LightFile::open(folder / out / "city.lights");
  };
  const auto lamps_of = [](const LightFile& file) {
    std::vector<Light> lamps;
    for (std::size_t n = 0; n < file.lights().size(); ++n)
      if (file.provenance()[n].family == static_cast<std::uint8_t>(LightFamily::lamp))
        lamps.push_back(file.lights()[n]);
    return lamps;
  };
  const LightFile laid_out = bake("laid_out");
  write_text(folder / "recipe.toml",
             "[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"streets.osm\", \"lamps.osm\"]\n"
             "[lamps]\nlayout = \"never\"\n");
  const LightFile given = bake("given");
  const std::vector<Light> a = lamps_of(laid_out), b = lamps_of(given);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GE(a.size(), 2u);
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_NEAR(a[n].position.x, b[n].position.x, 0.05);
    EXPECT_NEAR(a[n].position.y, b[n].position.y, 0.05);
    EXPECT_NEAR(a[n].position.z, b[n].position.z, 0.05);
    EXPECT_NEAR(a[n].flux_lm, b[n].flux_lm, 0.5);
  }
}

TEST(LayoutCommand, AnOsmFileThatCannotBeWrittenLeavesNothing) {
  const TempFolder folder;
  const std::filesystem::path recipe = dark_sample(folder, "");
  const std::size_t before = folder.entries();
  const Outcome outcome = lay_out(recipe, "--osm '" + (folder / "none/lamps.osm").string() + "'");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(folder.entries(), before);
}

}  // namespace
}  // namespace nightcity::nightbake
