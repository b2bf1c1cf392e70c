#include "runtime/experiments/pick_presets.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "runtime/experiments/sweep_points.h"

namespace nightcity::experiments {
namespace {

// A sweep's table with rows of estimator, candidates, view, frames, ms and error.
struct TestRow {
  const char *estimator, *candidates, *view, *frames, *ms, *error;
};

measure::Table make_table(const std::vector<TestRow>& rows) {
  measure::Table table{{"view", "frames", "ms", "relative_mse"}, {}};
  for (const render::Setting& setting : list_swept_settings())
    table.columns.push_back(render::column_of(setting));
  for (const TestRow& row : rows) {
    std::vector<std::string> cells(table.columns.size(), "-");
    cells[table.column("view")] = row.view;
    cells[table.column("frames")] = row.frames;
    cells[table.column("ms")] = row.ms;
    cells[table.column("relative_mse")] = row.error;
    cells[table.column("estimator")] = row.estimator;
    cells[table.column("candidates")] = row.candidates;
    table.rows.push_back(cells);
  }
  return table;
}

TEST(PickPresets, MeansOverViewsOfUnbiasedEstimatorsAndSingleFrames) {
  const auto combinations = read_swept_settings(make_table({
      {"traced", "8", "top", "1", "4", "0.01"},
      {"traced", "8", "street", "1", "1", "0.04"},
      {"traced", "8", "top", "16", "4", "0.001"},
      {"traced", "32", "top", "1", "9", "0.001"},
      {"traced", "32", "street", "1", "4", "0.001"},
      {"paper", "8", "top", "1", "0.1", "0.0001"},
      {"paper", "8", "street", "1", "0.1", "0.0001"},
      {"reference", "-", "top", "1", "50", "0.0001"},
      {"pairwise", "8", "top", "1", "1", "0.5"},
  }));
  ASSERT_EQ(combinations.size(), 2u) << "pairwise was measured in one view";
  EXPECT_EQ(combinations[0].settings, "estimator=traced candidates=8");
  EXPECT_NEAR(combinations[0].ms, 2, 1e-12);
  EXPECT_NEAR(combinations[0].relative_mse, 0.02, 1e-12);
  EXPECT_NEAR(combinations[1].ms, 6, 1e-12);
  EXPECT_THROW(read_swept_settings(make_table({{"paper", "8", "top", "1", "1", "1"}})), Error);
}

TEST(PickPresets, TakesTheKneeBetweenTheEndsOfTheFront) {
  std::vector<SweptSettings> all{{"a", 1, 1000, true}, {"b", 2, 16, true},  {"c", 3, 20, false},
                                 {"d", 4, 2, true},    {"e", 8, 1.8, true}, {"f", 16, 1, true},
                                 {"g", 20, 1.5, false}};
  const PresetPicks picks = pick_presets(all, 20);
  EXPECT_EQ(all[picks.fast].settings, "b") << "a has 1,000 times the smallest error";
  EXPECT_EQ(all[picks.balanced].settings, "d");
  EXPECT_EQ(all[picks.accurate].settings, "f");
  const std::string lines = to_preset_lines("gpu", all, picks);
  EXPECT_EQ(
      lines,
      "{\"gpu\", \"fast\", \"b\"},\n{\"gpu\", \"balanced\", \"d\"},\n"
      "{\"gpu\", \"accurate\", \"f\"},\n{\"gpu\", \"reference\", \"estimator=reference\"},\n");
}

TEST(PickPresets, OfASinglePointAreThatPoint) {
  const PresetPicks picks = pick_presets({{"a", 1, 1, true}});
  EXPECT_EQ(picks.fast, 0u);
  EXPECT_EQ(picks.balanced, 0u);
  EXPECT_EQ(picks.accurate, 0u);
}

}  // namespace
}  // namespace nightcity::experiments
