// The sweep's combinations of settings, and its table, which survives an interruption.
#include <gtest/gtest.h>

#include <set>

#include "formats/error.h"
#include "runtime/experiments/sweep_points.h"
#include "runtime/experiments/sweep_table.h"
#include "runtime/render/parse.h"
#include "support/temp_folder.h"

namespace nightcity::experiments {
namespace {

TEST(Sweep, DefaultListsHoldValuesThatTheSettingTakes) {
  for (const render::Setting& setting : list_swept_settings())
    for (const std::string& word :
         render::split_list(render::option_of(setting), render::default_list(setting))) {
      render::RenderSettings settings;
      EXPECT_NO_THROW(render::set_from_text(setting, settings, word)) << setting.name;
    }
}

// Scripts read sweep.csv by these names, and a table begun by an older version continues.
TEST(Sweep, ColumnsKeepTheirNamesAndOrder) {
  std::vector<std::string> columns;
  for (const render::Setting& setting : list_swept_settings())
    columns.push_back(render::column_of(setting));
  EXPECT_EQ(columns,
            (std::vector<std::string>{"estimator", "candidates", "neighbours", "radius", "history",
                                      "reach", "boost", "permute", "local-share", "wide-share",
                                      "uniform-share", "fleet-share", "visibility-reuse",
                                      "bounces", "cache", "cache-cell", "cache-paths"}));
}

TEST(Sweep, EveryCombinationComesOnceWithoutSettingsThatAnEstimatorLacks) {
  const auto all = list_combinations(
      {{"estimator", "ris,pairwise"}, {"candidates", "1,2,4"}, {"neighbours", "0,3,5"}});
  EXPECT_EQ(all.size(), 3u + 9u);  // ris has no neighbours
  EXPECT_EQ(std::set<SweepPoint>(all.begin(), all.end()).size(), all.size());
  for (const SweepPoint& point : all) {
    EXPECT_EQ(point.size(), list_swept_settings().size());
    const render::RenderSettings settings = to_settings(point);
    EXPECT_EQ(render::name_of(settings.sampling.estimator), point.at("estimator"));
    EXPECT_EQ(std::to_string(settings.sampling.candidates), point.at("candidates"));
  }
  EXPECT_THROW(list_combinations({{"candidates", "0"}}), UsageError);
  EXPECT_THROW(list_combinations({{"estimator", "magic"}}), UsageError);
}

TEST(Sweep, SettingsThatMakeNoDifferenceAreMarked) {
  const auto at = [](const std::string& estimator, const std::string& name,
                     std::map<std::string, std::string> more = {}) {
    more["estimator"] = estimator;
    return list_combinations(more).front().at(name);
  };
  EXPECT_EQ(at("reference", "candidates"), "-");
  EXPECT_EQ(at("ris", "candidates"), "4");
  EXPECT_EQ(at("ris", "max-history"), "-");
  EXPECT_EQ(at("ris", "near-share"), "0.5");
  EXPECT_EQ(at("paper", "near-share"), "-");
  EXPECT_EQ(at("paper", "max-history"), "20");
  EXPECT_EQ(at("paper", "history-falloff"), "-");
  EXPECT_EQ(at("traced", "visibility-reuse"), "-");
  EXPECT_EQ(at("basic", "visibility-reuse"), "no");
  EXPECT_EQ(at("traced", "radius", {{"neighbours", "0"}}), "-");
  EXPECT_EQ(at("traced", "permute", {{"max-history", "0"}}), "-");
  EXPECT_EQ(at("traced", "disocclusion-boost", {{"neighbours", "0"}}), "-");
}

TEST(Sweep, RowsAreKeptUntilTheSceneChanges) {
  const test::TempFolder folder;
  const std::vector<std::string> columns{"view", "frames", "ms"};
  {
    SweepTable table(folder.path(), "one", columns, 2);
    EXPECT_FALSE(table.restarted());
    table.add({"top", "1", "0.5"});
  }
  test::write_text(folder / "reference-top.exr", "");
  {
    const SweepTable table(folder.path(), "one", columns, 2);
    EXPECT_TRUE(table.holds({"top", "1"}));
    EXPECT_FALSE(table.holds({"top", "2"}));
  }
  const SweepTable table(folder.path(), "two", columns, 2);
  EXPECT_TRUE(table.restarted());
  EXPECT_FALSE(table.holds({"top", "1"}));
  EXPECT_FALSE(std::filesystem::exists(folder / "reference-top.exr"));
}

}  // namespace
}  // namespace nightcity::experiments
