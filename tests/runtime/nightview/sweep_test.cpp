// The price list: combinations, a table that survives being stopped, and the commands that measure, as users
// meet them.
#include "runtime/nightview/sweep.h"

#include <gtest/gtest.h>

#include <set>

#include "formats/error.h"
#include "formats/light_file.h"
#include "runtime/nightview/lamp_field.h"
#include "support/process.h"
#include "support/scenes.h"

namespace nightcity {
namespace {

TEST(Sweep, DefaultsOfEveryKnobAreValuesItTakes) {
  for (const Knob& knob : knobs())
    for (const std::string& word : split_list(knob.name, knob.defaults)) {
      RenderSettings settings;
      EXPECT_NO_THROW(knob.set(settings, knob, word)) << knob.name;
      EXPECT_THROW(knob.set(settings, knob, "many"), UsageError) << knob.name;
    }
  EXPECT_THROW(split_list("--candidates", "1,,2"), UsageError);
}

TEST(Sweep, EverySettingComesOnceAndNoKnobThatAnEstimatorLacks) {
  const auto all = combinations(
      {{"estimator", "ris,pairwise"}, {"candidates", "1,2,4"}, {"neighbours", "0,3,5"}});
  EXPECT_EQ(all.size(), 3u + 9u);  // ris has no neighbours
  EXPECT_EQ(std::set<KnobValues>(all.begin(), all.end()).size(), all.size());
  for (const KnobValues& values : all) {
    EXPECT_EQ(values.size(), knobs().size());
    const RenderSettings settings = settings_of(values);
    EXPECT_EQ(name_of(settings.estimator), values.at("estimator"));
    EXPECT_EQ(std::to_string(settings.candidates), values.at("candidates"));
  }
  EXPECT_THROW(combinations({{"candidates", "0"}}), UsageError);
  EXPECT_THROW(combinations({{"estimator", "magic"}}), UsageError);
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

TEST(LampField, HasTheLampsAskedForAndAllShine) {
  for (const std::size_t lamps : {1ul, 10ul, 1000ul}) {
    const RenderScene scene = lamp_field(lamps);
    EXPECT_EQ(scene.lights.size(), lamps);
    EXPECT_EQ(scene.bad_lights, 0u);
  }
}

// A plane, a box and two lamps as the two files of a scene.
class MeasuringCommands : public testing::Test {
 protected:
  void SetUp() override {
    test::SceneBuilder builder;
    builder.ground(20).box({-2, 0, -2}, {2, 4, 2});
    SceneWriter writer(folder / "city.glb", {});
    writer.add_material(builder.scene().materials[0]);
    writer.add_mesh(builder.scene().meshes[0]);
    writer.add_node(builder.scene().nodes[0]);
    writer.finish({});
    std::vector<Light> lights{test::lamp({-6, 6, 3}, 5000), test::lamp({5, 7, 4}, 3000)};
    lights[1].id = 2;
    const std::vector<LightProvenance> provenance(2);
    write_light_file(folder / "city.lights", {{}, lights, provenance, {}, {}});
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
  EXPECT_EQ(read_csv(folder / "out/sweep.csv").rows.size(), 4u);
  const test::Outcome second = nightview("sweep", options + "1,4");
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const Table table = read_csv(folder / "out/sweep.csv");
  EXPECT_EQ(table.rows.size(), 8u);
  for (const auto& row : table.rows) {
    EXPECT_GT(std::stod(row[table.column("ms")]), 0);
    EXPECT_GT(std::stod(row[table.column("relative_mse")]), 0);
    EXPECT_LT(std::stod(row[table.column("relative_mse")]), 10);
  }
  EXPECT_NE(test::read_text(folder / "out/sweep-overview.svg").find("pairwise"), std::string::npos);
  EXPECT_NE(test::read_text(folder / "out/sweep.md").find("| pairwise |"), std::string::npos);
}

TEST_F(MeasuringCommands, FlightMeasuresEveryFrameItIsAskedTo) {
  const test::Outcome outcome = nightview(
      "flight", scene() + " --size 16x12 --frames 5 --every 2 --reference-frames 1 --pictures");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Table table = read_csv(folder / "out/flight.csv");
  ASSERT_EQ(table.rows.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(table.rows[i][table.column("relative_mse")].empty(), i % 2 || i == 0) << i;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/frame-0004.png"));
  EXPECT_NE(outcome.out.find("worst"), std::string::npos);
}

TEST_F(MeasuringCommands, StrategiesMeasuresEverySourceOfCandidates) {
  const test::Outcome outcome =
      nightview("strategies", "--lights 3 --size 8x6 --frames 1 --reference-frames 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_csv(folder / "out/strategies.csv").rows.size(), 16u);
}

TEST_F(MeasuringCommands, FleetTellsTheCostOfMovingVehiclesApart) {
  const test::Outcome outcome =
      test::run_program("nightview", "-q fleet --vehicles 0,30 --lamps 20 --size 8x6 --frames 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
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
}  // namespace nightcity
