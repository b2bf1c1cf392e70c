// The files that a user names: a recipe, or the city's files themselves.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/bake/recipe/recipe.h"

namespace nightcity::bake {

/// Returns the recipe, where one is given alone; else a recipe of defaults with the CityGML and OSM
/// files among `inputs`, whose content decides what they are. A folder stands for the CityGML in
/// it. Throws Error for a file of another kind, UsageError where a recipe is given among other
/// files.
Recipe read_inputs(const std::vector<std::filesystem::path>& inputs);

}  // namespace nightcity::bake
