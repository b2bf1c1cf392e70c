// A recipe's messages advise the table of a key, how paths are written, and the nearest word.
#include <gtest/gtest.h>

#include "support/error_message.h"
#include "support/temp_folder.h"
#include "tools/bake/recipe/recipe.h"

namespace nightcity::bake {
namespace {

// Returns what is said of these lines below a recipe's first two.
std::string why(const std::string& lines, const std::string& first = "[city]\nfiles = 'a.gml'\n") {
  const test::TempFolder folder;
  test::write_text(folder / "recipe.toml", first + lines);
  return test::message_of([&] { read_recipe(folder / "recipe.toml"); });
}

void expect_advice(const std::string& message, const std::string& advice) {
  EXPECT_NE(message.find(advice), std::string::npos) << message;
}

TEST(RecipeRemedies, AKeyOfAnotherTableIsToldWithItsOwn) {
  expect_advice(why("[windows]\ntrees = 'none'\n"),
                "recipe.toml:4: unknown key [windows] trees; [ground] has a key of that name");
  expect_advice(
      why("", "files = 'a.gml'\n"),
      "recipe.toml:1: files stands in no table; [city] and [osm] have a key of that name");
  expect_advice(why("[windows]\nsed = 3\n"), "did you mean \"seed\"?");
}

TEST(RecipeRemedies, PathsOfOtherSystemsAreToldWithTheirRemedy) {
  const auto of_path = [](const std::string& path) {
    return why("", "[city]\nfiles = ['" + path + "']\n");
  };
  expect_advice(of_path("https://example.org/a.gml"), "address of the web");
  expect_advice(of_path("data\\a.gml"), "/ lies between folders");
  expect_advice(of_path("~/a.gml"), "whole path");
  expect_advice(why("[[lamps.luminaires]]\nfile = 'C:\\a.ies'\n"), "/ lies between folders");
  expect_advice(why("", "[city]\nfiles = [\"data\\a.gml\"]\n"), "'single quotes'");
  // Here a name may hold the sign.
  const test::TempFolder folder;
  test::write_text(folder / "a\\b.gml", "");
  test::write_text(folder / "recipe.toml", "[city]\nfiles = ['a\\b.gml']\n");
  EXPECT_NO_THROW(read_recipe(folder / "recipe.toml"));
}

TEST(RecipeRemedies, WordsAndNumbersAreNamed) {
  expect_advice(why("[[lamps.luminaires]]\nfile = 'a.ies'\nroads = ['residental']\n"),
                "\"residental\"; did you mean \"residential\"?");
  expect_advice(why("[windows]\nseed = 9223372036854775807\n"), "is not between 0 and 2147483647");
  expect_advice(why("", std::string("\xFF\xFE[\0c\0", 6)), "is in UTF-16");
}

}  // namespace
}  // namespace nightcity::bake
