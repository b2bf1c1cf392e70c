// Every recipe that the fuzzer starts from or has found, read in each test run: an Error or a
// recipe, never a crash.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/corpus.h"
#include "tools/bake/recipe/recipe.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nightcity::bake {
namespace {

const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/bake/corpus";

TEST(Corpus, EveryRecipeIsReadOrRefused) {
  test::feed_each_file(corpus, 6, LLVMFuzzerTestOneInput);
}

TEST(Corpus, HoldsWholeRecipes) {
  for (const char* name : {"berlin.toml", "everything.toml"})
    EXPECT_NO_THROW(read_recipe(corpus / name)) << name;
}

}  // namespace
}  // namespace nightcity::bake
