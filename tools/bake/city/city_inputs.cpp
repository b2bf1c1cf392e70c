#include "tools/bake/city/city_inputs.h"

#include <algorithm>

namespace nightcity::bake {

std::string CityInputs::name() const {
  if (!recipe.empty()) return recipe.string();
  if (!files.empty()) return files.front().string();
  return maps.empty() ? std::string() : maps.front().string();
}

bool CityInputs::is_map_alone() const {
  return !files.empty() && std::all_of(files.begin(), files.end(), [&](const auto& file) {
    return std::find(maps.begin(), maps.end(), file) != maps.end();
  });
}

}  // namespace nightcity::bake
