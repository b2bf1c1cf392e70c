// Writes the recipe of a plan.
#pragma once

#include <filesystem>
#include <string>

#include "tools/survey/plan.h"

namespace nightcity::survey {

/// Returns the recipe, as TOML with comments that say what each file is, why others are left out
/// and what is missing. Paths are relative to `folder`, in which the recipe will lie. A model of
/// more than twenty files in one folder is named by that folder, if all in it belong to the model.
std::string make_recipe_text(const Plan& plan, const std::filesystem::path& folder);

}  // namespace nightcity::survey
