#include "tools/bake/recipe/recipe.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "formats/error.h"
#include "formats/program/toml_file.h"
#include "tools/bake/recipe/key.h"
#include "tools/bake/recipe/tables.h"
#include "tools/bake/recipe/value.h"
#include "tools/inputs/file_format.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;

// The nearest word of a table says little of a key that belongs in another, or stands in none.
void refuse_key_elsewhere(const std::string& file, const toml::key& key, const std::string& what,
                          const std::vector<recipe::Table>& tables) {
  std::vector<std::string> owners;
  for (const recipe::Table& table : tables)
    for (const recipe::Key& each : table.keys)
      if (each.name == key.str()) owners.push_back("[" + table.name + "]");
  if (!owners.empty())
    throw UsageError(file, key.source().begin.line,
                     fmt::format("{}; {} {} a key of that name", what, fmt::join(owners, " and "),
                                 owners.size() == 1 ? "has" : "have"));
}

void read_tables(const std::string& file, const toml::table& document,
                 const std::vector<recipe::Table>& tables) {
  for (const auto& [name, node] : document) {
    const std::string table_name(name.str());
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const recipe::Table& each) {
      return each.name == table_name;
    });
    if (table == tables.end()) {
      if (!node.is_table())
        refuse_key_elsewhere(file, name, table_name + " stands in no table", tables);
      std::vector<std::string> known;
      for (const recipe::Table& each : tables) known.push_back(each.name);
      program::refuse_unknown_key(file, name, "table [" + table_name + "]", known);
    }
    const toml::table* settings = node.as_table();
    if (!settings) recipe::Value{file, table_name, node}.refuse("is not a table");
    for (const auto& [key, value] : *settings) {
      const std::string_view own_name = key.str();  // clang 14 captures no structured binding
      if (std::none_of(table->keys.begin(), table->keys.end(),
                       [&](const recipe::Key& each) { return each.name == own_name; }))
        refuse_key_elsewhere(file, key, "unknown key [" + table_name + "] " + std::string(own_name),
                             tables);
    }
    if (table->on_present) table->on_present();
    recipe::read_keys(file, "[" + table_name + "] ", *settings, table->keys);
  }
}

// The words of a TOML parser would not say that a city or a map stands in place of its recipe.
void refuse_data(const fs::path& path) {
  if (path.extension() == ".toml") return;
  std::error_code ignored;
  std::string what = "a folder";
  if (!fs::is_directory(path, ignored)) {
    try {
      what = inputs::find_format(path).name;
    } catch (const Error&) {
      return;  // it may be a recipe of another name; the parser says what is wrong
    }
  }
  throw Error(path.string(), "is " + what +
                                 ", not a recipe: `nightbake new DIR FILES...` writes one "
                                 "for such files");
}

}  // namespace

Recipe read_recipe(const fs::path& path) {
  const std::string file = path.string();
  refuse_data(path);
  const toml::table document = program::read_toml(path);
  Recipe recipe;
  recipe.path = path;
  read_tables(file, document, recipe::make_tables(recipe, path.parent_path()));
  if (recipe.city.bounds && !recipe.city.frame.control_points.empty())
    throw UsageError(
        file, "[city] bounds and control_points both place the model: one of them is enough");
  if (recipe.city.files.empty() && recipe.osm.files.empty())
    throw UsageError(file, "names no city: [city] files = [\"...\"] is missing");
  return recipe;
}

}  // namespace nightcity::bake
