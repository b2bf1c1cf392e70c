// docs/recipe.md is what the program says of its own keys, and what it says is true.
#include <gtest/gtest.h>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/bake/recipe/reference.h"
#include "tools/bake/recipe/tables.h"

namespace nightcity::recipe {
namespace {

using test::TempFolder;

// The keys of all tables write into these.
struct Targets {
  bake::Recipe recipe{};
  bake::LuminaireFile luminaire{};
  inventory::InventoryFile inventory{};
};

// All tables, those of rows included.
std::vector<Table> all_tables(Targets& targets) {
  std::vector<Table> tables = make_tables(targets.recipe, {});
  tables.push_back(make_luminaire_table(targets.luminaire, {}));
  tables.push_back(make_inventory_table(targets.inventory, {}));
  return tables;
}

// A recipe of the default file and one more key, as a user would write it.
std::string to_recipe(const Table& table, const Key& key, const std::string& value) {
  std::string text = table.name == "city" ? "" : "[city]\nfiles = 'a.gml'\n";
  const bool is_row = table.name.find('.') != std::string::npos;
  text += is_row ? "[[" + table.name + "]]\n" : "[" + table.name + "]\n";
  if (table.name == "city" && key.name != "files") text += "files = 'a.gml'\n";
  if (is_row && key.name != "file") text += "file = 's.ldt'\n";
  return text + key.name + " = " + value + "\n";
}

TEST(RecipeReference, ThePageHoldsIt) {
  const std::string page = test::read_text(std::string(NIGHTCITY_SOURCE_DIR) + "/docs/recipe.md");
  EXPECT_NE(page.find(make_markdown_reference()), std::string::npos)
      << "docs/recipe.md is out of date: replace its reference by the output of\n"
         "  nightbake recipe --markdown";
}

TEST(RecipeReference, EveryKeyHasWordsAndAnExample) {
  Targets targets;
  for (const Table& table : all_tables(targets)) {
    EXPECT_GT(table.help.size(), 10u) << table.name;
    for (const Key& key : table.keys) {
      EXPECT_GT(key.help.size(), 10u) << key.name;
      EXPECT_FALSE(key.type.empty()) << key.name;
      EXPECT_FALSE(key.default_value.empty() && key.example.empty()) << key.name;
    }
  }
}

TEST(RecipeReference, EveryExampleAndDefaultCanBeRead) {
  const TempFolder folder;
  Targets targets;
  for (const Table& table : all_tables(targets))
    for (const Key& key : table.keys)
      for (const std::string& value : {key.example, key.default_value}) {
        if (value.empty()) continue;
        test::write_text(folder / "recipe.toml", to_recipe(table, key, value));
        EXPECT_NO_THROW(bake::read_recipe(folder / "recipe.toml")) << table.name << "." << key.name;
      }
}

TEST(RecipeReference, NumbersBeyondTheStatedRangeAreRefused) {
  const TempFolder folder;
  Targets targets;
  std::size_t tried = 0;
  for (const Table& table : all_tables(targets))
    for (const Key& key : table.keys) {
      if (key.type != "number" && key.type != "integer") continue;
      ++tried;
      const std::string value = key.type == "number" ? "1e30" : "-1";
      test::write_text(folder / "recipe.toml", to_recipe(table, key, value));
      EXPECT_THROW(bake::read_recipe(folder / "recipe.toml"), UsageError) << key.name;
    }
  EXPECT_GT(tried, 10u);
}

TEST(RecipeReference, ATableOrAKeyCanBeAskedFor) {
  const std::string everything = make_text_reference("");
  EXPECT_NE(everything.find(make_text_reference("traffic")), std::string::npos);
  EXPECT_EQ(make_text_reference("tile_m"), make_text_reference("city.tile_m"));
  EXPECT_NE(make_text_reference("tile_m").find("default 250"), std::string::npos);
  const std::string seeds = make_text_reference("seed");
  EXPECT_NE(seeds.find("[windows]"), std::string::npos);
  EXPECT_NE(seeds.find("[traffic]"), std::string::npos);
  try {
    make_text_reference("tle_m");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("tile_m"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nightcity::recipe
