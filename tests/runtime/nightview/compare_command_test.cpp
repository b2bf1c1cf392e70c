// nightview compare as its users meet it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/measure/exr.h"
#include "runtime/measure/pictures.h"
#include "support/process.h"
#include "support/temp_folder.h"

namespace nightcity::nightview {
namespace {

class CompareCommand : public testing::Test {
 protected:
  void SetUp() override {
    measure::write_exr(folder / "a.exr", test::grey(4, 3, 1.5f));
    measure::write_exr(folder / "b.exr", test::grey(4, 3, 2.0f));
    measure::write_exr(folder / "wide.exr", test::grey(6, 2, 2.0f));
  }

  test::Outcome compare(const std::string& a, const std::string& b,
                        const std::string& options = "") const {
    return test::run_program("nightview", "compare " + options + " '" + (folder / a).string() +
                                              "' '" + (folder / b).string() + "'");
  }

  test::TempFolder folder;
};

TEST_F(CompareCommand, JsonHasTheKeysOthersScriptAgainst) {
  const test::Outcome outcome = compare("a.exr", "b.exr", "--json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_GT(json.at("rmse8").get<double>(), 1);
  EXPECT_NEAR(json.at("relative_mse").get<double>(), 0.25 / 4.04, 1e-6);
  EXPECT_NEAR(json.at("mean_signed_error").get<double>(), -0.5, 1e-6);
  EXPECT_NEAR(json.at("relative_mean_signed_error").get<double>(), -0.25, 1e-6);
  EXPECT_EQ(json.at("fireflies").get<double>(), 0);
}

TEST_F(CompareCommand, TextNamesEveryFigure) {
  const test::Outcome outcome = compare("a.exr", "b.exr");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* key :
       {"rmse8", "relative_mse", "mean_signed_error", "relative_mean_signed_error", "fireflies"})
    EXPECT_NE(outcome.out.find(key), std::string::npos) << key;
}

TEST_F(CompareCommand, BadDataEndsWith1AndOneLine) {
  for (const auto& [a, b] : {std::pair{"a.exr", "wide.exr"}, std::pair{"a.exr", "missing.exr"},
                             std::pair{"missing.exr", "b.exr"}}) {
    const test::Outcome outcome = compare(a, b, "--json");
    EXPECT_EQ(outcome.exit_code, 1) << a << " " << b;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(CompareCommand, WrongUsageEndsWith2) {
  EXPECT_EQ(test::run_program("nightview", "compare").exit_code, 2);
  EXPECT_EQ(compare("a.exr", "b.exr", "--no-such-option").exit_code, 2);
}

}  // namespace
}  // namespace nightcity::nightview
