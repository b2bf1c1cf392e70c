// The sweep's combinations of settings, and its table, which survives an interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
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
  EXPECT_EQ(columns, (std::vector<std::string>{
                         "estimator",        "candidates",     "neighbours",    "radius",
                         "history",          "reach",          "boost",         "permute",
                         "local-share",      "wide-share",     "uniform-share", "fleet-share",
                         "visibility-reuse", "bounces",        "cache",         "cache-cell",
                         "cache-paths",      "air-candidates", "air-block",     "resolution-scale",
                         "half-rate",        "roulette"}));
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

TEST(Sweep, TablesOfOlderVersionsGetTheColumnsThatTheyLack) {
  const test::TempFolder folder;
  SweepTable(folder.path(), "one", {"view", "frames", "ms"}, 2).add({"top", "1", "0.5"});
  SweepTable longer(folder.path(), "one", {"view", "frames", "ms", "more"}, 2);
  EXPECT_EQ(longer.table().rows.at(0), (std::vector<std::string>{"top", "1", "0.5", ""}));
  longer.add({"top", "2", "0.5", "3"});
  EXPECT_THROW(SweepTable(folder.path(), "one", {"view", "frames", "ms"}, 2), Error);
  EXPECT_THROW(SweepTable(folder.path(), "one", {"view", "frames", "s", "more"}, 2), Error);
}

TEST(Front, HoldsThePointsThatNoOtherSurpasses) {
  using Marks = std::vector<bool>;
  EXPECT_EQ(find_front({}), Marks());
  EXPECT_EQ(find_front({{1, 9}, {2, 5}, {3, 6}, {4, 1}}), (Marks{true, true, false, true}));
  EXPECT_EQ(find_front({{2, 5}, {1, 5}}), (Marks{false, true})) << "as good, and cheaper";
  EXPECT_EQ(find_front({{1, 5}, {1, 4}}), (Marks{false, true}));
  EXPECT_EQ(find_front({{1, 5}, {1, 5}, {2, 5}}), (Marks{true, true, false})) << "equal ones both";
  EXPECT_EQ(find_front({{std::nan(""), 1}, {1, 2}}), (Marks{false, true}));
}

// Every pair is compared with every other: the definition itself.
TEST(Front, IsThatOfTheDefinition) {
  std::mt19937 random(3);
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < 300; ++i) points.push_back({random() % 40, random() % 40});
  const std::vector<bool> front = find_front(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool surpassed = std::any_of(points.begin(), points.end(), [&](const auto& p) {
      return p != points[i] && p.first <= points[i].first && p.second <= points[i].second;
    });
    EXPECT_EQ(front[i], !surpassed) << i;
  }
}

TEST(Front, IsThatOfEachViewAndNumberOfFrames) {
  const test::TempFolder folder;
  SweepTable table(folder.path(), "one",
                   {"view", "camera", "size", "device", "frames", "ms", "relative_mse", "front"},
                   5);
  table.add({"top", "c", "8x8", "d", "1", "1", "0.5", ""});
  table.add({"top", "c", "8x8", "d", "1", "2", "0.6", ""});
  table.add({"top", "c", "8x8", "d", "9", "2", "0.1", ""});
  table.add({"street", "c", "8x8", "d", "1", "2", "0.6", ""});
  table.mark_front();
  std::vector<std::string> marks;
  for (const auto& row : measure::read_csv(folder / "sweep.csv").rows) marks.push_back(row.back());
  EXPECT_EQ(marks, (std::vector<std::string>{"yes", "no", "yes", "yes"}));
  const auto json = nlohmann::json::parse(to_json(table.table()));
  EXPECT_EQ(json.at(1).at("ms"), 2);
  EXPECT_EQ(json.at(1).at("front"), false);
  EXPECT_EQ(json.at(3).at("view"), "street");
}

}  // namespace
}  // namespace nightcity::experiments
