// --settings and --leave-out as users of the commands give them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/process.h"
#include "support/scene_files.h"
#include "support/scenes.h"

namespace nightcity::nightview {
namespace {

// A plane with a lamp and a window as the two files of a scene.
class SettingsOption : public testing::Test {
 protected:
  void SetUp() override {
    test::SceneBuilder builder;
    builder.ground(20);
    test::write_scene_files(
        folder / "city.glb", builder.scene(),
        {test::lamp({-6, 6, 3}, 5000), test::window({0, 3, 0}, {0, 0, 1}, 1, 1, 300)});
  }
  test::Outcome bench(const std::string& settings, const std::string& options = "") const {
    test::write_text(folder / "s.toml", settings);
    return test::run_program("nightview", "-q bench" + test::quoted(folder / "city.glb") +
                                              "--frames 1 --warm-up 0 --json --settings" +
                                              test::quoted(folder / "s.toml") + options);
  }
  test::TempFolder folder;
};

TEST_F(SettingsOption, IsOverruledByTheCommandLineAlone) {
  const test::Outcome outcome = bench(
      "[render]\nsize = \"8x6\"\ncandidates = 5\nneighbours = 2\nleave-out = [\"windows\"]\n"
      "ev = 3.5\n[window]\nanything = 1\n",
      "--neighbours 3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["candidates"], 5);
  EXPECT_EQ(json["neighbours"], 3);
  EXPECT_EQ(json["size"], (std::vector{8, 6}));
  EXPECT_EQ(json["lights"], 1) << "the window is left out";
  const auto whole = nlohmann::json::parse(
      bench("[render]\nleave-out = [\"windows\"]\n", "--size 8x6 --leave-out none").out);
  EXPECT_EQ(whole["lights"], 2);
}

TEST_F(SettingsOption, NamesFileAndLineOfWhatIsWrong) {
  for (const char* bad :
       {"candidates = 0", "size = \"8\"", "time = \"25:00\"", "ev = \"x\"", "tone = \"x\"",
        "moon = \"1\"", "leave-out = [\"lamps\"]", "leave-out = 3", "no-such = 1"}) {
    const test::Outcome outcome = bench(std::string("[render]\n") + bad + "\n");
    EXPECT_EQ(outcome.exit_code, 2) << bad;
    EXPECT_NE(outcome.err.find("s.toml:2: "), std::string::npos) << bad << ": " << outcome.err;
  }
  EXPECT_EQ(bench("[render\n").exit_code, 1);
}

TEST_F(SettingsOption, NamesFilesBesideItself) {
  const test::Outcome saved = test::run_program(
      "nightview", "-q render" + test::quoted(folder / "city.glb") + "--size 8x6 --frames 1 --out" +
                       test::quoted(folder / "a.png") + "--save-camera" +
                       test::quoted(folder / "eye.json") + "--leave-out windows");
  ASSERT_EQ(saved.exit_code, 0) << saved.err;
  EXPECT_NE(test::read_text(folder / "a.png").find(std::string("Left out\0windows", 16)),
            std::string::npos)
      << "the picture says that something is missing";
  const test::Outcome outcome = bench("[render]\nsize = \"8x6\"\ncamera = \"eye.json\"\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

// A file as `price` writes it serves every command that renders a scene; the window's test is in
// tests/runtime/viewer.
TEST_F(SettingsOption, IsTakenByEveryCommandThatRenders) {
  test::write_text(folder / "s.toml",
                   "# Found by nightview price\n[render]\nbounces = 1\nhalf-rate = true\n"
                   "candidates = 4\nsize = \"8x6\"\nleave-out = [\"windows\"]\n");
  const auto out = [&](const char* name) { return "--out" + test::quoted(folder / name); };
  for (const auto& [command, options] :
       {std::pair{"render", "--frames 1 " + out("a.exr")},
        std::pair{"flight",
                  "--path orbit --frames 2 --every 100 --reference-frames 1 " + out("flight")},
        std::pair{"record", "--path orbit --duration 0.1 --frames 1 " + out("record")},
        std::pair{"bench", std::string("--frames 1 --warm-up 0")},
        std::pair{"sweep", "--frames 1 --reference-frames 1 --warm-up 0 " + out("sweep")},
        std::pair{"price", std::string("--frames 1 --runs 3")},
        std::pair{"upward", out("upward")}}) {
    const test::Outcome outcome =
        test::run_program("nightview", std::string("-q ") + command +
                                           test::quoted(folder / "city.glb") + options +
                                           " --settings" + test::quoted(folder / "s.toml"));
    EXPECT_EQ(outcome.exit_code, 0) << command << ": " << outcome.err;
  }
  EXPECT_NE(test::read_text(folder / "a.exr").find("half rate"), std::string::npos);
  EXPECT_NE(test::read_text(folder / "sweep/sweep.csv").find(",yes,1,"), std::string::npos)
      << "the file's half rate takes the place of the list";
}

TEST_F(SettingsOption, PresetsGiveWayToSettingsAndOptions) {
  const auto candidates = [&](const std::string& settings, const std::string& options) {
    const test::Outcome outcome = bench(settings, options + " --size 8x6");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["candidates"].get<int>();
  };
  const int accurate = candidates("", "--preset accurate");
  EXPECT_EQ(candidates("[render]\npreset = \"accurate\"\n", ""), accurate);
  EXPECT_LT(candidates("[render]\npreset = \"accurate\"\n", "--preset fast"), accurate)
      << "the command line's preset goes before the file's";
  EXPECT_EQ(candidates("[render]\ncandidates = 3\n", "--preset accurate"), 3);
  EXPECT_EQ(candidates("[render]\ncandidates = 3\n", "--preset accurate --candidates 5"), 5);
  EXPECT_EQ(bench("", "--preset best").exit_code, 2);
}

TEST_F(SettingsOption, APictureIsRenderedUntilItsNoiseIsSmallEnough) {
  const auto render = [&](const std::string& options) {
    return test::run_program("nightview", "render" + test::quoted(folder / "city.glb") +
                                              "--size 16x12 --no-cache --out" +
                                              test::quoted(folder / "a.png") + options);
  };
  const test::Outcome loose = render("--target-error 10 --frames 40");
  ASSERT_EQ(loose.exit_code, 0) << loose.err;
  EXPECT_NE(loose.err.find("info: 4 frames"), std::string::npos) << loose.err;
  EXPECT_NE(loose.err.find("within the target"), std::string::npos) << loose.err;
  const test::Outcome strict = render("--target-error 1e-9 --frames 9");
  ASSERT_EQ(strict.exit_code, 0) << strict.err;
  EXPECT_NE(strict.err.find("info: 10 frames"), std::string::npos) << strict.err;
  EXPECT_NE(strict.err.find("ABOVE the target"), std::string::npos) << strict.err;
}

TEST_F(SettingsOption, ABudgetThatNothingKeepsLeadsToTheLeastWork) {
  const test::Outcome outcome = test::run_program(
      "nightview", "render" + test::quoted(folder / "city.glb") + "--size 16x12 --frames 1 " +
                       "--candidates 4 --neighbours 1 --budget-ms 1e-6 --out" +
                       test::quoted(folder / "a.png"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(
      outcome.err.find(
          "Starts with 1 candidates, 0 neighbours, 50 % of each side, 1 paths a cell: none keeps"),
      std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace nightcity::nightview
