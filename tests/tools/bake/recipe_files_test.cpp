// Which files a recipe names.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/read_recipe_text.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/recipe/recipe.h"

namespace nightcity::bake {
namespace {

using test::read_recipe_text;
using test::TempFolder;

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++found;
  return found;
}

TEST(Recipe, WhatIsNamedAgainCountsOnceAndIsSaid) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "tiles");
  test::write_text(folder / "tiles" / "a.gml", "x");
  std::string again, rows;
  for (int i = 0; i < 999; ++i) {
    again += ", './b.gml', 'tiles', 'tiles/'";
    rows += ", {file = 's.ldt', roads = ['primary']}";
  }
  ::testing::internal::CaptureStderr();
  const Recipe recipe = read_recipe_text(
      folder, "[city]\nfiles = ['b.gml', 'tiles/a.gml'" + again + "]\n[osm]\nfiles = ['m.osm', " +
                  "'n.osm', 'm.osm']\n[terrain]\ndem = ['a.tif', 'b.tif', 'a.tif']\n[lights]\n" +
                  "edits = ['a.json', 'b.json', 'a.json']\n[lamps]\nluminaires = [" +
                  "{file = 's.ldt'}, {file = 's.ldt', roads = ['primary']}" + rows + "]\n" +
                  "inventories = [{file = 'l.csv', layer = 'x'}, {file = 'l.csv', layer = 'y'}, " +
                  "{file = 'l.csv', layer = 'x'}]\n");
  const std::string said = ::testing::internal::GetCapturedStderr();
  using Paths = std::vector<std::filesystem::path>;
  EXPECT_EQ(recipe.city.files, (Paths{folder / "b.gml", folder / "tiles/a.gml"}));
  EXPECT_EQ(recipe.osm.files, (Paths{folder / "m.osm", folder / "n.osm"}));
  EXPECT_EQ(recipe.terrain.elevation_models, (Paths{folder / "a.tif", folder / "b.tif"}));
  // The later of two edits of a light holds, so a file keeps the place of its last mention.
  EXPECT_EQ(recipe.lights.edits, (Paths{folder / "b.json", folder / "a.json"}));
  EXPECT_EQ(recipe.lamps.luminaires.size(), 2u);
  ASSERT_EQ(recipe.lamps.inventories.size(), 2u);
  EXPECT_EQ(recipe.lamps.inventories[1].layer, "y");
  // 999 times b.gml and 2 * 999 times the folder, of which the first brings a.gml again.
  EXPECT_EQ(count(said, ": [city] files names files again that it has named, 2997 times"), 1u)
      << said;
  EXPECT_EQ(count(said, "[lamps] luminaires holds rows again that it has held, 999 times"), 1u);
  EXPECT_EQ(count(said, "note: "), 6u);
}

TEST(Recipe, AFolderStandsForItsCityFilesInTheOrderOfTheirNames) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "tiles");
  for (const char* name :
       {"b.GML", "a.gml", "c.xml", "d.gml.gz", "e.zip", "read.me", "a.png", "f.gz"})
    test::write_text(folder / "tiles" / name, "x");
  const Recipe recipe = read_recipe_text(folder, "[city]\nfiles = ['tiles']\n");
  EXPECT_EQ(recipe.city.files,
            (std::vector<std::filesystem::path>{folder / "tiles/a.gml", folder / "tiles/b.GML",
                                                folder / "tiles/c.xml", folder / "tiles/d.gml.gz",
                                                folder / "tiles/e.zip"}));
  std::filesystem::create_directory(folder / "none");
  EXPECT_THROW(read_recipe_text(folder, "[city]\nfiles = ['none']\n"), Error);
}

TEST(Recipe, OfObjFilesThatDifferInTheirLevelTheBestIsBaked) {
  const TempFolder folder;
  for (const char* inside : {"lod1", "lod2"}) {
    std::filesystem::create_directories(folder / "city" / inside);
    test::write_text(folder / "city" / inside / "tile.obj", "v 0 0 0\n");
  }
  const auto files_at = [&](const std::string& lod) {
    return to_bake_options(
               read_recipe_text(folder, "[city]\nfiles = ['city']\nlod = " + lod + "\n"))
        .city.files;
  };
  using Files = std::vector<std::filesystem::path>;
  EXPECT_EQ(files_at("2"), Files{folder / "city/lod2/tile.obj"});
  EXPECT_EQ(files_at("1"), Files{folder / "city/lod1/tile.obj"});
}

TEST(Recipe, FoldersInsideAFolderAreEnteredAndHiddenOnesAreNot) {
  const TempFolder folder;
  for (const char* inside : {"udx/bldg/51", "udx/tran", "udx/.cache", "codelists"})
    std::filesystem::create_directories(folder / inside);
  for (const char* name : {"udx/tran/a.gml", "udx/bldg/51/b.gml", "udx/bldg/c.gml",
                           "udx/.cache/d.gml", "udx/bldg/.e.gml"})
    test::write_text(folder / name, "x");
  std::filesystem::create_directory_symlink(folder / "udx", folder / "udx/round");
  const Recipe recipe = read_recipe_text(folder, "[city]\nfiles = ['udx']\n");
  EXPECT_EQ(recipe.city.files, (std::vector<std::filesystem::path>{folder / "udx/bldg/51/b.gml",
                                                                   folder / "udx/bldg/c.gml",
                                                                   folder / "udx/tran/a.gml"}));
}

TEST(Recipe, RecipesOfRealCitiesTakeTheirDataFromTheDataFolderAndAreListed) {
  const std::filesystem::path source = NIGHTCITY_SOURCE_DIR;
  const std::string page = test::read_text(source / "pipelines/README.md");
  std::size_t recipes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source / "pipelines")) {
    if (entry.path().extension() != ".toml") continue;
    ++recipes;
    const Recipe recipe = read_recipe(entry.path());
    const std::string data = (source / "data").string() + "/";
    for (const auto* files : {&recipe.city.files, &recipe.osm.files})
      for (const std::filesystem::path& file : *files)
        EXPECT_TRUE(file.string().starts_with(data)) << file;
    EXPECT_NE(page.find("| `" + entry.path().stem().string() + "` |"), std::string::npos)
        << entry.path();
  }
  EXPECT_EQ(recipes, 6u);
}

TEST(Recipe, ACityOrAMapInItsPlaceIsNamed) {
  const test::TempFolder folder;
  const auto why = [&](const char* name, const std::string& text) {
    test::write_text(folder / name, text);
    return test::message_of([&] { read_recipe(folder / name); });
  };
  EXPECT_NE(why("a.osm", "<osm version='0.6'/>").find("is OSM, not a recipe: `nightbake new"),
            std::string::npos);
  EXPECT_NE(why("a.json", "{\"type\":\"CityJSON\"}").find("is CityJSON, not a recipe"),
            std::string::npos);
  EXPECT_NE(test::message_of([&] { read_recipe(folder.path()); }).find("is a folder, not a recipe"),
            std::string::npos);
  EXPECT_EQ(why("recipe.txt", "[osm]\nfiles = ['a.osm']\n"), "") << "a recipe may have any name";
}

}  // namespace
}  // namespace nightcity::bake
