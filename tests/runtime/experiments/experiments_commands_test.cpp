// sweep, flight, strategies and vehicles as their users call them.
#include <gtest/gtest.h>

#include "runtime/measure/table.h"
#include "support/process.h"
#include "support/scene_files.h"
#include "support/scenes.h"

namespace nightcity::experiments {
namespace {

// A plane, a box and two lamps as the two files of a scene.
class MeasuringCommands : public testing::Test {
 protected:
  void SetUp() override {
    test::SceneBuilder builder;
    builder.ground(20).box({-2, 0, -2}, {2, 4, 2});
    test::write_scene_files(folder / "city.glb", builder.scene(),
                            {test::lamp({-6, 6, 3}, 5000), test::lamp({5, 7, 4}, 3000)});
  }
  test::Outcome nightview(const std::string& command, const std::string& options) const {
    return test::run_program("nightview", "-q " + command + " " + options + " --out '" +
                                              (folder / "out").string() + "'");
  }
  std::string scene() const { return "'" + (folder / "city.glb").string() + "'"; }
  test::TempFolder folder;
};

TEST_F(MeasuringCommands, SweepWritesTableAndPlotAndGoesOnWhereItStopped) {
  const std::string options =
      scene() +
      " --size 16x12 --estimator ris,pairwise --neighbours 2 --frames 1,2 --warm-up 1 "
      "--reference-frames 2 --candidates ";
  const test::Outcome first = nightview("sweep", options + "1");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(measure::read_csv(folder / "out/sweep.csv").rows.size(), 4u);
  const test::Outcome second = nightview("sweep", options + "1,4");
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const measure::Table table = measure::read_csv(folder / "out/sweep.csv");
  EXPECT_EQ(table.rows.size(), 8u);
  for (const auto& row : table.rows) {
    EXPECT_GT(std::stod(row[table.column("ms")]), 0);
    EXPECT_GT(std::stod(row[table.column("relative_mse")]), 0);
    EXPECT_LT(std::stod(row[table.column("relative_mse")]), 10);
  }
  EXPECT_NE(test::read_text(folder / "out/sweep-overview.svg").find("pairwise"), std::string::npos);
  EXPECT_NE(test::read_text(folder / "out/sweep.md").find("| pairwise |"), std::string::npos);
  EXPECT_NE(test::read_text(folder / "out/sweep.json").find("\"front\": true"), std::string::npos);
  EXPECT_TRUE(std::any_of(table.rows.begin(), table.rows.end(),
                          [&](const auto& row) { return row[table.column("front")] == "yes"; }));
}

TEST_F(MeasuringCommands, SweepTakesTheFolderOfAScene) {
  const std::string options =
      " --size 8x6 --estimator ris --frames 1 --warm-up 0 --reference-frames 1 --candidates ";
  const test::Outcome whole = nightview("sweep", test::quoted(folder.path()) + options + "1");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  // The scene is the same one by its name, so that the table goes on.
  ASSERT_EQ(nightview("sweep", scene() + options + "2").exit_code, 0);
  EXPECT_EQ(measure::read_csv(folder / "out/sweep.csv").rows.size(), 2u);
  const test::Outcome none = nightview("sweep", test::quoted(folder / "out") + options + "1");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("holds no .glb"), std::string::npos) << none.err;
}

TEST_F(MeasuringCommands, SweepTakesSettingsFromAFile) {
  test::write_text(folder / "s.toml",
                   "[render]\nestimator = \"ris\"\ncandidates = 3\nwet = 0.5\ntime = \"21:00\"\n"
                   "size = \"8x6\"\nleave-out = [\"lamp-size\"]\n");
  const std::string options = scene() + " --frames 1 --warm-up 0 --reference-frames 1 --settings" +
                              test::quoted(folder / "s.toml");
  const test::Outcome outcome = nightview("sweep", options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const measure::Table table = measure::read_csv(folder / "out/sweep.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0][table.column("candidates")], "3");
  EXPECT_EQ(table.rows[0][table.column("size")], "8x6");
  ASSERT_EQ(nightview("sweep", options + " --candidates 1,2").exit_code, 0);
  EXPECT_EQ(measure::read_csv(folder / "out/sweep.csv").rows.size(), 3u);
  const std::string mark = test::read_text(folder / "out/scene.txt");
  EXPECT_NE(mark.find("wet=0.5 time=32400 leave-out=lamp-size"), std::string::npos) << mark;
  EXPECT_EQ(
      test::run_program("nightview", "-q upward" + test::quoted(folder / "city.glb") +
                                         "--rays 16 --settings" + test::quoted(folder / "s.toml") +
                                         "--out" + test::quoted(folder / "up"))
          .exit_code,
      0);
}

TEST_F(MeasuringCommands, SweepMeasuresOneFrameWhileTheClockRuns) {
  const std::string options = scene() +
                              " --size 16x12 --estimator ris --candidates 4 --warm-up 2 "
                              "--reference-frames 2 --time-step 0.25 --frames ";
  const test::Outcome outcome = nightview("sweep", options + "1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const measure::Table table = measure::read_csv(folder / "out/sweep.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0][table.column("time_step_s")], "0.25");
  EXPECT_GT(std::stod(table.rows[0][table.column("ms")]), 0);
  EXPECT_EQ(nightview("sweep", options + "1,2").exit_code, 2) << "a mean over moments";
}

TEST_F(MeasuringCommands, FlightMeasuresEveryFrameItIsAskedTo) {
  const test::Outcome outcome = nightview(
      "flight", scene() + " --size 16x12 --frames 5 --every 2 --reference-frames 1 --pictures");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const measure::Table table = measure::read_csv(folder / "out/flight.csv");
  ASSERT_EQ(table.rows.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(table.rows[i][table.column("relative_mse")].empty(), i % 2 || i == 0) << i;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/frame-0004.png"));
  EXPECT_NE(outcome.out.find("worst"), std::string::npos);
}

TEST_F(MeasuringCommands, GovernedFlightsSayWhatTheyChose) {
  const test::Outcome outcome =
      nightview("flight", scene() +
                              " --size 16x12 --frames 6 --every 100 --reference-frames 1 "
                              "--candidates 4 --neighbours 1 --budget-ms 1e-6 --target-error 0.5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("budget         1e-06 ms kept in 0.00 % of the frames"),
            std::string::npos)
      << outcome.out;
  const measure::Table table = measure::read_csv(folder / "out/flight.csv");
  for (const auto& row : table.rows) {
    EXPECT_EQ(row[table.column("candidates")], "1");
    EXPECT_EQ(row[table.column("neighbours")], "0");
    EXPECT_EQ(row[table.column("resolution_scale")], "0.5");
    EXPECT_EQ(row[table.column("half_rate")], "no");
  }
}

TEST_F(MeasuringCommands, StrategiesMeasuresEverySourceOfCandidates) {
  const test::Outcome outcome =
      nightview("strategies", "--lights 3 --size 8x6 --frames 1 --reference-frames 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(measure::read_csv(folder / "out/strategies.csv").rows.size(), 16u);
}

TEST_F(MeasuringCommands, VehiclesSeparatesTheCostOfMovingThem) {
  const test::Outcome outcome = test::run_program(
      "nightview", "-q vehicles --vehicles 0,30 --lamps 20 --size 8x6 --frames 1 --time-step 0.1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(test::run_program("nightview", "-q fleet --vehicles 0 --lamps 20 --size 8x6 --frames 1")
                .exit_code,
            0)
      << "the command's old name";
  EXPECT_NE(outcome.out.find("| 0 | 20 | "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("| 30 | 140 | "), std::string::npos)
      << "four lights each: " << outcome.out;
}

TEST_F(MeasuringCommands, WrongUsageEndsWith2AndBadDataWith1) {
  EXPECT_EQ(nightview("sweep", scene() + " --candidates none").exit_code, 2);
  EXPECT_EQ(nightview("sweep", scene() + " --frames 4,2").exit_code, 2);
  EXPECT_EQ(nightview("strategies", "--lights 0").exit_code, 2);
  EXPECT_EQ(nightview("sweep", "'" + (folder / "none.glb").string() + "'").exit_code, 1);
  EXPECT_EQ(nightview("flight", scene() + " --path nowhere.json").exit_code, 1);
}

}  // namespace
}  // namespace nightcity::experiments
