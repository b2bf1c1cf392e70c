// Decides which of the files that were looked at make one city, and what is missing.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/survey/survey.h"

namespace nightcity::survey {

struct Plan {
  using Files = std::vector<const SurveyedFile*>;
  Files cities, maps, rasters, inventories, luminaires;
  /// Files that could be used but for a reason: they are named in the recipe, as a comment.
  std::vector<std::pair<const SurveyedFile*, std::string>> left_out;
  std::vector<std::string> missing;  // what would make the city better, and where it can be had
  Box box;                           // of the city

  bool is_empty() const { return cities.empty() && maps.empty(); }
};

/// City models that name a CRS decide where the city lies, maps without such: where several places
/// are at hand (choose_place.h), one is taken. Files that lie elsewhere, or cannot be placed beside
/// it, are left out. `files` must outlive the plan.
Plan make_plan(const std::vector<SurveyedFile>& files);

}  // namespace nightcity::survey
