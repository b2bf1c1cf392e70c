// nightbake recipe: the reference of a recipe's tables and keys.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "tools/bake/recipe/reference.h"
#include "tools/nightbake/commands.h"

namespace nightcity::nightbake {
namespace {

struct RecipeArguments {
  std::string word;
  bool markdown = false;
};

}  // namespace

void add_recipe_command(CLI::App& app) {
  auto* command = app.add_subcommand("recipe", "Explain the tables and keys of a recipe");
  auto arguments = std::make_shared<RecipeArguments>();
  auto* word = command->add_option("word", arguments->word,
                                   "A table or key, such as city or tile_m (default: all of them)");
  command->add_flag("--markdown", arguments->markdown, "Print the tables of docs/recipe.md instead")
      ->excludes(word);
  command->footer("Examples:\n  nightbake recipe traffic\n  nightbake recipe city.bounds");
  command->callback([arguments] {
    fmt::print("{}", arguments->markdown ? recipe::make_markdown_reference()
                                         : recipe::make_text_reference(arguments->word));
  });
}

}  // namespace nightcity::nightbake
