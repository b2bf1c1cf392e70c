// Parts of small scenes are priced whose worth is known without measuring.
#include "runtime/experiments/price.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "runtime/render/settings_file.h"
#include "support/process.h"
#include "support/scene_files.h"
#include "support/scenes.h"

namespace nightcity::experiments {
namespace {

using test::lamp;
using test::SceneBuilder;
using test::window;

const char* view_from_above =
    R"({"position": [0, 14, 0.1], "target": [0, 0, 0], "up": [0, 0, -1], "fov_deg": 60})";

PriceOptions options_of(SceneBuilder builder, scene::SceneLights lights) {
  PriceOptions options;
  options.width = 24;
  options.height = 16;
  options.views = {view_from_above};
  options.runs = 4;
  options.frames = 8;
  options.timed = 3;
  options.settings.sampling.jitter = false;
  options.load = [builder, lights](const scene::PartSet& left_out) {
    return scene::make_render_scene(builder.scene(), lights, left_out);
  };
  return options;
}

PriceReport price(const PriceOptions& options) {
  program::ProgressDisplay progress;
  return price_scene(options, progress);
}

const SimplerModel& row_of(const PriceReport& report, const std::string& name) {
  for (const SimplerModel& row : report.rows)
    if (row.name == name) return row;
  ADD_FAILURE() << "no row " << name;
  return report.rows.front();
}

scene::SceneLights with_families(std::vector<Light> lights, std::vector<LightFamily> families) {
  scene::SceneLights all;
  all.lights = test::to_large(lights);
  all.families = std::move(families);
  return all;
}

TEST(Price, OfWindowsThatGiveAllTheLightIsAllOfIt) {
  const std::vector<Light> lights{window({0, 3, -4}, {0, -0.6f, 0.8f}, 1, 1, 3000)};
  const PriceReport report =
      price(options_of(SceneBuilder().ground(20), with_families(lights, {LightFamily::window})));
  const SimplerModel& windows = row_of(report, "windows");
  ASSERT_EQ(windows.views.size(), 1u);
  EXPECT_EQ(windows.count, 1u);
  EXPECT_EQ(windows.views[0].relative_mean.value, -1);
  EXPECT_EQ(windows.views[0].relative_mean.error, 0);
  EXPECT_TRUE(report.choice.cuts.empty()) << "nothing else is there, and they are needed";
}

// A window and a lamp of the same kind of light, far from each other: the share of the window is
// that of its own picture, by the reference and to its standard errors.
TEST(Price, OfOneOfTwoLightsIsItsShare) {
  std::vector<Light> lights{window({-5, 6, 0}, {0, -1, 0}, 0.5f, 0.5f, 2000),
                            lamp({5, 6, 0}, 4000)};
  // Its normal is down, so that any horizontal direction is its width.
  lights[0].tangent = {1, 0, 0};
  const std::vector<LightFamily> families{LightFamily::window, LightFamily::lamp};
  PriceOptions options = options_of(SceneBuilder().ground(40), with_families(lights, families));
  const PriceReport both = price(options);
  PriceOptions lamp_only =
      options_of(SceneBuilder().ground(40), with_families({lights[1]}, {families[1]}));
  const PriceReport alone = price(lamp_only);
  const measure::Estimate share = row_of(both, "windows").views[0].relative_mean;
  EXPECT_NEAR(share.value, alone.means[0] / both.means[0] - 1, 5 * share.error + 2e-3);
  EXPECT_GT(row_of(both, "windows").saved.bytes, 0);
}

TEST(Price, TellsAbsentPartsAndDoesNotMeasureThem) {
  const PriceReport report =
      price(options_of(SceneBuilder().ground(20), with_families({lamp({0, 6, 0}, 4000, 0)}, {})));
  for (const SimplerModel& row : report.rows) {
    EXPECT_EQ(row.count, 0u) << row.name;
    EXPECT_TRUE(row.views.empty()) << row.name;
  }
  EXPECT_TRUE(report.measured.empty());
  EXPECT_TRUE(report.choice.cuts.empty());
  EXPECT_GT(report.means[0], 0);
}

// Schedules under which every light is on at this time change nothing.
TEST(Price, OfAPartThatChangesNothingIsZeroWithinItsStandardErrors) {
  scene::SceneLights lights =
      with_families({lamp({0, 6, 0}, 4000, 0), lamp({3, 6, 2}, 4000, 0)}, {});
  lights.schedules = {{0, 1}};
  lights.switches = {18000};
  for (Light& light : lights.lights) light.schedule = 0;
  PriceOptions options = options_of(SceneBuilder().ground(20), lights);
  options.frames = 16;
  const PriceReport report = price(options);
  const SimplerModel& row = row_of(report, "schedules");
  ASSERT_EQ(row.views.size(), 1u);
  // A t distribution of three degrees of freedom: 1 in 1,000 lies beyond 10 standard errors.
  const measure::ModelDifference& d = row.views[0];
  EXPECT_LT(std::abs(d.relative_mean.value), 10 * d.relative_mean.error + 1e-6);
  EXPECT_LT(std::abs(d.relative_mse.value), 10 * d.relative_mse.error + 1e-9);
  for (const std::size_t cut : report.choice.cuts)
    EXPECT_EQ(report.rows[report.measured[cut]].name, "schedules");
}

// A lamp's own glowing surface, seen from above, shines a thousandfold as its material says once
// the lamp has no size. What the lamp lights hardly changes.
TEST(Price, OfTheSizeOfLampsIsThatOfWhatTheyLight) {
  SceneBuilder builder;
  builder.ground(20);
  Scene& scene = builder.scene();
  scene.materials.push_back({"glow", glm::vec3(0), glm::vec3(1e6f), 1.0f, true});
  scene.meshes.push_back(
      {"lamp",
       {ScenePrimitive{
           1, {{-1, 6, -1}, {-1, 6, 1}, {1, 6, 1}, {1, 6, -1}}, {0, 1, 2, 0, 2, 3}, {}, {}, {}}}});
  scene.nodes.push_back({"lamp", "lamp", 1, false, {SceneInstance{}}});
  scene.nodes.back().instances[0].light = 0;
  PriceOptions options = options_of(builder, with_families({lamp({0, 6, 0}, 4000, 0.3f)}, {}));
  options.frames = 16;
  options.settings.sampling.estimator = render::Estimator::reference;
  const PriceReport report = price(options);
  const SimplerModel& row = row_of(report, "lamp-size");
  ASSERT_EQ(row.views.size(), 1u);
  EXPECT_TRUE(row.without_lamps_seen);
  EXPECT_NEAR(row.views[0].relative_mean.value, 0, 0.05);
  ASSERT_EQ(report.lamps_seen.size(), 1u);
  EXPECT_GT(report.lamps_seen[0], 0.01);
  EXPECT_LT(report.lamps_seen[0], 0.2);
  EXPECT_FALSE(row_of(report, "lamp-bodies").without_lamps_seen);
}

// In a furnace of albedo 1/2 each bounce adds half of what the one before added: with three, what
// no bounce leaves out is 1 - 1 / (1 + 1/2 + 1/4 + 1/8).
TEST(Price, OfBouncesInAFurnaceIsAGeometricSeries) {
  SceneBuilder builder(0.5f);
  builder.box({-10, -10, -10}, {10, 10, 10}).glow(1);
  PriceOptions options = options_of(builder, {});
  options.settings.indirect = {.bounces = 3, .cache = false};
  options.views = {
      R"({"position": [0, 0, 0], "target": [1, 0, 0], "up": [0, 1, 0], "fov_deg": 60})"};
  const PriceReport report = price(options);
  const double all = 1 + 0.5 + 0.25 + 0.125;
  const double with[] = {1, 1.5, 1.75};
  for (int bounces = 0; bounces < 3; ++bounces) {
    const SimplerModel& row = row_of(report, "bounces " + std::to_string(bounces));
    EXPECT_NEAR(row.views[0].relative_mean.value, with[bounces] / all - 1, 0.01) << bounces;
  }
}

// A bake whose only lamp has half the flux is half as bright.
TEST(Price, OfAnotherBakeIsItsDifference) {
  PriceOptions options =
      options_of(SceneBuilder().ground(20), with_families({lamp({0, 6, 0}, 4000)}, {}));
  options.others.emplace_back("dim", [](const scene::PartSet&) {
    return SceneBuilder().ground(20).with({lamp({0, 6, 0}, 2000)});
  });
  options.others.emplace_back("same", options.load);
  // The same place, in a model space that begins 30 m west, 20 m south and 5 m lower.
  options.others.emplace_back("moved", [](const scene::PartSet&) {
    const glm::vec3 moved(30, 5, -20);
    SceneBuilder builder;
    builder.quad(moved + glm::vec3(-20, 0, -20), moved + glm::vec3(-20, 0, 20),
                 moved + glm::vec3(20, 0, 20), moved + glm::vec3(20, 0, -20));
    builder.scene().georeference.origin = {-30, -20, -5};
    return builder.with({lamp(glm::vec3(0, 6, 0) + moved, 4000)});
  });
  const PriceReport report = price(options);
  ASSERT_EQ(report.rows.size(), 3u);
  const measure::Estimate dim = row_of(report, "dim").views[0].relative_mean;
  EXPECT_NEAR(dim.value, -0.5, 10 * dim.error + 1e-6);
  const measure::Estimate same = row_of(report, "same").views[0].relative_mean;
  EXPECT_NEAR(same.value, 0, 10 * same.error + 1e-6);
  const measure::ModelDifference& moved = row_of(report, "moved").views[0];
  EXPECT_NEAR(moved.relative_mean.value, 0, 10 * moved.relative_mean.error + 1e-5);
  EXPECT_NEAR(moved.relative_mse.value, 0, 10 * moved.relative_mse.error + 1e-5);
  EXPECT_TRUE(report.choice.trials.empty());
}

TEST(Price, SavingsCountMillisecondsThatAreMeasuredOnly) {
  const ModelCost whole{{10, 0.1}, 1000, 1};
  EXPECT_NEAR(find_saving({{5, 0.1}, 100, 0}, whole), 0.5 * (0.5 + 0.1), 1e-12);
  EXPECT_NEAR(find_saving({{5, 3}, 100, 0}, whole), 0.05, 1e-12);
  EXPECT_EQ(find_saving({}, whole), 0);
  EXPECT_EQ(find_saving({}, {}), 0);
}

// A plane with a lamp and a dim window, as the two files of a scene, priced as users do it.
class PriceCommand : public testing::Test {
 protected:
  void SetUp() override {
    SceneBuilder builder;
    builder.ground(20);
    std::vector<Light> lights{lamp({-6, 6, 3}, 5000, 0), window({0, 3, 0}, {0, 0, 1}, 1, 1, 1e-3f)};
    lights[1].id = 2;
    std::vector<LightProvenance> provenance(2);
    provenance[1].family = static_cast<std::uint8_t>(LightFamily::window);
    test::write_scene_files(folder / "city.glb", builder.scene(), {{}, lights, provenance, {}, {}});
  }
  test::Outcome nightview(const std::string& command, const std::string& options) const {
    return test::run_program("nightview",
                             "-q " + command + test::quoted(folder / "city.glb") + options);
  }
  std::string quick() const {
    return " --size 12x8 --runs 3 --frames 2 --timed-frames 2 --bounces 1 --no-cache ";
  }
  test::TempFolder folder;
};

TEST_F(PriceCommand, WritesSettingsThatEveryCommandTakes) {
  const test::Outcome outcome =
      nightview("price", quick() + "--views top --error 60 --json --wet 0.5 --out" +
                             test::quoted(folder / "cheap.toml"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_LE(json["chosen"].value("error_with_two_standard_errors", 0.0), 60);
  EXPECT_NE(json["chosen"]["leave_out"].get<std::string>().find("windows"), std::string::npos)
      << outcome.out;
  for (const auto& part : json["parts"])
    EXPECT_EQ(part["present"], part["things"] > 0) << part["name"];
  EXPECT_TRUE(json["trials"].back()["verification"]);
  const render::SettingsFile file = render::read_settings_file(folder / "cheap.toml");
  ASSERT_NE(file.find("leave-out"), nullptr);
  ASSERT_NE(file.find("bounces"), nullptr);
  EXPECT_EQ(file.find("jitter"), nullptr) << "that is for measuring";
  const std::string settings =
      " --size 12x8 --frames 1 --settings" + test::quoted(folder / "cheap.toml");
  EXPECT_EQ(nightview("render", settings + "--out" + test::quoted(folder / "a.png")).exit_code, 0);
  const test::Outcome bench = nightview("bench", settings + "--warm-up 0 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_EQ(nlohmann::json::parse(bench.out)["lights"], 1) << "the window is left out";
}

TEST_F(PriceCommand, PrintsATableOfWhatIsThereAndNamesWhatIsNot) {
  const test::Outcome outcome = nightview("price", quick() + "--views top --error 0");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("| windows | 1 | top |"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("Absent here: traffic"), std::string::npos) << outcome.out;
}

TEST_F(PriceCommand, MeasuresOtherBakes) {
  const test::Outcome outcome = nightview(
      "price", quick() + "--views top --json --against" + test::quoted(folder / "city.glb"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["parts"].size(), 1u);
  EXPECT_EQ(json["parts"][0]["saved_bytes"], 0);
  EXPECT_FALSE(json.contains("chosen"));
}

TEST_F(PriceCommand, RefusesWhatItCannotMeasure) {
  EXPECT_EQ(nightview("price", quick() + "--runs 2").exit_code, 2);
  EXPECT_EQ(nightview("price", quick() + "--by rms").exit_code, 2);
  EXPECT_EQ(nightview("price", quick() + "--views nowhere.json").exit_code, 1);
  EXPECT_EQ(nightview("price", quick() + "--settings nowhere.toml").exit_code, 1);
}

}  // namespace
}  // namespace nightcity::experiments
