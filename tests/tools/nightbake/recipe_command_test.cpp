// nightbake recipe: the reference that docs/recipe.md is made from.
#include <gtest/gtest.h>

#include "support/process.h"

namespace nightcity::nightbake {
namespace {

TEST(RecipeCommand, ExplainsAllKeysOneTableOrOneKey) {
  const test::Outcome all = test::run_program("nightbake", "recipe");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  const test::Outcome table = test::run_program("nightbake", "recipe output");
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(all.out.find(table.out), std::string::npos);
  const test::Outcome key = test::run_program("nightbake", "recipe output.draco_tolerance_m");
  EXPECT_NE(key.out.find("number, m; 0.00001 to 10; default 0.01"), std::string::npos) << key.out;
}

TEST(RecipeCommand, AnUnknownWordIsWrongUsageAndNamesTheNearest) {
  const test::Outcome outcome = test::run_program("nightbake", "recipe draca");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("\"draco\""), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace nightcity::nightbake
