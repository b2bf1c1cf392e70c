#include "tools/bake/read_inputs.h"

#include <fmt/core.h>

#include <cstdio>
#include <system_error>
#include <utility>

#include "formats/error.h"
#include "tools/inputs/city_files.h"
#include "tools/inputs/file_format.h"
#include "tools/inputs/named_once.h"

namespace nightcity::bake {
namespace {

std::vector<std::filesystem::path> list_once(std::vector<std::filesystem::path> files) {
  inputs::NamedOnce once = inputs::name_once(std::move(files));
  if (once.repeats > 0)
    fmt::print(stderr, "note: {}: files are named again, {} in all: each is read once\n",
               once.first_repeat.string(), once.repeats);
  return std::move(once.files);
}

}  // namespace

Recipe read_inputs(const std::vector<std::filesystem::path>& inputs) {
  if (inputs.size() == 1 && inputs.front().extension() == ".toml")
    return read_recipe(inputs.front());
  Recipe recipe;
  for (const auto& input : list_once(inputs)) {
    std::error_code error;
    if (input.extension() == ".toml")
      throw UsageError(input.string(), "a recipe is given alone: name the other files in it");
    if (std::filesystem::is_directory(input, error)) {
      const auto found = inputs::city_files(input);
      recipe.city.files.insert(recipe.city.files.end(), found.begin(), found.end());
      continue;
    }
    switch (inputs::find_format(input).kind) {
      case inputs::FileKind::city:
        recipe.city.files.push_back(input);
        break;
      case inputs::FileKind::osm:
        recipe.osm.files.push_back(input);
        break;
      default:
        throw Error(input.string(), "is neither a city model nor OSM");
    }
  }
  recipe.city.files = list_once(std::move(recipe.city.files));
  return recipe;
}

}  // namespace nightcity::bake
