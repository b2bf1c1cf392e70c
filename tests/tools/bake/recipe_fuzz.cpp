// libFuzzer target: any bytes as a recipe.
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "support/fuzz_file.h"
#include "tools/bake/recipe/recipe.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const test::FuzzFile file(data, size);
  try {
    const bake::Recipe recipe = bake::read_recipe(file.path());
    if (recipe.city.files.empty() && recipe.osm.files.empty()) std::abort();
  } catch (const Error&) {  // what a broken recipe deserves
  }
  return 0;
}
