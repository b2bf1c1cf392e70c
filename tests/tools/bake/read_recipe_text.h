// A recipe, read from its text.
#pragma once

#include <string>

#include "support/temp_folder.h"
#include "tools/bake/recipe/recipe.h"

namespace nightcity::test {

inline bake::Recipe read_recipe_text(const TempFolder& folder, const std::string& text) {
  write_text(folder / "recipe.toml", text);
  return bake::read_recipe(folder / "recipe.toml");
}

}  // namespace nightcity::test
