// nightbake price as its users call it.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "support/process.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

class PriceCommand : public testing::Test {
 protected:
  test::Outcome price(const std::string& options) const {
    return test::run_program("nightbake", "-q price" + test::quoted(recipe) + "--out" +
                                              test::quoted(folder / "out") + options);
  }
  test::TempFolder folder;
  std::filesystem::path recipe = test::write_sample(folder);
};

TEST_F(PriceCommand, BakesEachVariantAndComparesTheFiles) {
  const test::Outcome outcome = price("--no-pictures --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, nlohmann::json> rows;
  for (const auto& row : nlohmann::json::parse(outcome.out)) rows[row["name"]] = row;
  EXPECT_GT(rows.size(), 5u);
  for (const auto& [name, row] : rows) {
    EXPECT_GT(row["glb_bytes"], 0) << name;
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name / "city.glb")) << name;
    EXPECT_FALSE(row.contains("pictures"));
  }
  // The cube's floor is gone.
  ASSERT_TRUE(rows.count("no-hidden"));
  EXPECT_LT(rows["no-hidden"]["glb_bytes"], rows["whole"]["glb_bytes"]);
  EXPECT_EQ(rows["draco-10mm"]["max_shift_m"], 0.01);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/price.json"));
  EXPECT_NE(test::read_text(folder / "out/price.md").find("| draco-1m |"), std::string::npos);
}

TEST_F(PriceCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(price("--only draco").exit_code, 2);
  EXPECT_EQ(price("--only no-hidden --nightview /no/such/program").exit_code, 2);
  EXPECT_EQ(
      test::run_program("nightbake", "-q price none.toml --out" + test::quoted(folder / "out"))
          .exit_code,
      1);
}

// This test needs the renderer and a device.
TEST_F(PriceCommand, TellsTheErrorOfPictures) {
  if (!std::filesystem::exists(std::filesystem::path(NIGHTCITY_BUILD_DIR) / "nightview"))
    GTEST_SKIP() << "nightview is not built";
  const test::Outcome outcome = price(
      "--only no-hidden --json --pictures \"--size 12x8 --frames 2 --runs 3 --timed-frames 2 "
      "--views top --bounces 0 --time 22:00\"");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_FALSE(json[0].contains("pictures"));
  const auto& mean = json[1]["pictures"]["views"][0]["relative_mean_signed_error"];
  // Surfaces that nobody sees are worth nothing.
  EXPECT_LT(std::abs(mean["value"].get<double>()),
            10 * mean["standard_error"].get<double>() + 1e-6);
}

}  // namespace
}  // namespace nightcity::nightbake
