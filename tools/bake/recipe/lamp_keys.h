// The table [lamps] of a recipe.
#pragma once

#include <filesystem>

#include "tools/bake/recipe/recipe.h"
#include "tools/bake/recipe/value.h"

namespace nightcity::recipe {

/// Its keys; handlers refer to `lamps`. `folder`: what names of files are relative to.
Table lamp_settings(Recipe::Lamps& lamps, const std::filesystem::path& folder);

}  // namespace nightcity::recipe
