#include "runtime/render/settings_file.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/setting_table.h"
#include "support/temp_folder.h"

namespace nightcity::render {
namespace {

class SettingsFiles : public testing::Test {
 protected:
  SettingsFile read(const std::string& text) const {
    test::write_text(folder / "a.toml", text);
    return read_settings_file(folder / "a.toml");
  }
  std::string message_of(const std::string& text) const {
    try {
      RenderSettings settings;
      apply_settings_file(read(text), settings, [](auto&) { return false; });
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  test::TempFolder folder;
};

TEST_F(SettingsFiles, GiveBackEverySettingThatWasWritten) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::pairwise;
  settings.sampling.candidates = 7;
  settings.sampling.near_share = 0.1f;
  settings.sampling.jitter = false;
  settings.sampling.seed = 4294967295u;
  settings.reuse.permute = true;
  settings.reuse.history_falloff_m = 0.001f;
  settings.indirect.bounces = 3;
  settings.environment.sky_cd_m2.x = 1e-4f;
  SettingsFile file{folder / "b.toml", list_changes(settings, {}), {{"font-size", "20"}}};
  file.render.push_back({"leave-out", "windows,trees"});
  file.render.push_back({"camera", "a \"b\"\\\n\t\x01.json"});
  file.render.push_back({"time", "20:00"});
  file.render.push_back({"moon", "160,35"});
  write_settings_file(file, "first\nsecond");
  const SettingsFile back = read_settings_file(folder / "b.toml");
  RenderSettings again;
  apply_settings_file(back, again, [](auto&) { return false; });
  for (const Setting& setting : list_settings())
    EXPECT_EQ(text_of(setting, again), text_of(setting, settings)) << setting.name;
  ASSERT_EQ(back.render.size(), file.render.size());
  for (std::size_t i = 0; i < back.render.size(); ++i) {
    EXPECT_EQ(back.render[i].name, file.render[i].name);
    EXPECT_EQ(back.render[i].text, file.render[i].text) << back.render[i].name;
  }
  ASSERT_EQ(back.window.size(), 1u);
  EXPECT_EQ(back.window[0].text, "20");
  EXPECT_TRUE(test::read_text(folder / "b.toml").starts_with("# first\n# second\n"));
}

TEST_F(SettingsFiles, GiveBackTextsThatLookLikeNumbersAndKeysThatAreNoWords) {
  SettingsFile file{folder / "b.toml", {}, {}};
  for (const char* text :
       {"007", "1.0", "-.5", "1.e5", "1e5", "1e+30", "0.25", "-3", "-0", "", "9223372036854775807",
        "9223372036854775808", "inf", "nan", "1_000", "0x10", "yes", "no", "2026-11-29"})
    file.window.push_back({"key-" + std::to_string(file.window.size()), text});
  for (const char* name : {"two words", "a.b", "", "\"'", "\n", "\xc3\xbc", " = true"})
    file.window.push_back({name, "1"});
  file.window.push_back({"quotes", "'''a\\\n'b"});
  file.window.push_back({"escapes", "a\tb\"\x7f"});
  file.render = {{"camera", "007"}};
  write_settings_file(file, "");
  const SettingsFile back = read_settings_file(file.path);
  EXPECT_EQ(back.render.at(0).text, "007");
  ASSERT_EQ(back.window.size(), file.window.size());
  for (std::size_t i = 0; i < back.window.size(); ++i) {
    EXPECT_EQ(back.window[i].name, file.window[i].name) << i;
    EXPECT_EQ(back.window[i].text, file.window[i].text) << file.window[i].name;
  }
}

TEST_F(SettingsFiles, LeaveAloneWhatTheCommandLineHasSet) {
  const SettingsFile file = read("[render]\ncandidates = 4\nneighbours = 1\nhistory = 2\n");
  RenderSettings settings;
  apply_settings_file(file, settings, [](const std::string& name) { return name == "candidates"; });
  EXPECT_EQ(settings.sampling.candidates, RenderSettings{}.sampling.candidates);
  EXPECT_EQ(settings.reuse.neighbours, 1u);
  EXPECT_EQ(settings.reuse.max_history, 2) << "by its older name";
}

TEST_F(SettingsFiles, MessagesNameFileLineAndTheNearestKey) {
  EXPECT_NE(message_of("[render]\n\ncandidate = 4\n")
                .find("a.toml:3: unknown key [render] "
                      "candidate; did you mean "
                      "\"candidates\"?"),
            std::string::npos)
      << message_of("[render]\n\ncandidate = 4\n");
  EXPECT_NE(message_of("[renders]\n")
                .find("a.toml:1: unknown table [renders]; did you mean "
                      "\"render\"?"),
            std::string::npos);
  EXPECT_NE(message_of("render = 3\n").find("a.toml:1: render is not a table"), std::string::npos);
  for (const char* bad :
       {"candidates = 0", "candidates = 1e9", "candidates = nan", "candidates = \"many\"",
        "candidates = [1]", "candidates = {}", "bounces = -1", "jitter = 2", "estimator = true",
        "sky = inf", "leave-out = ['aim,']", "leave-out = ['']"}) {
    const std::string message = message_of(std::string("[render]\n") + bad + "\n");
    EXPECT_NE(message.find("a.toml:2: "), std::string::npos) << bad << ": " << message;
  }
  EXPECT_NE(message_of("[render\n").find("a.toml:1: is not TOML"), std::string::npos);
  EXPECT_NE(message_of("[render]\na" + std::string(200, '.') + "b = 1\n").find("a.toml:2: "),
            std::string::npos);
}

TEST_F(SettingsFiles, ThatAreAbsentAreAnError) {
  EXPECT_THROW(read_settings_file(folder / "none.toml"), Error);
}

TEST(LeftOut, KnowsItsNamesAndRefusesOthers) {
  EXPECT_TRUE(LeftOut("").empty());
  EXPECT_TRUE(LeftOut("none").empty());
  EXPECT_EQ(LeftOut("trees,windows,trees").text(), "windows,trees");
  for (const ModelPart& part : list_model_parts()) EXPECT_EQ(LeftOut(part.name).text(), part.name);
  for (const char* bad : {"window", "windows,", ",", " windows", "all"})
    EXPECT_THROW(LeftOut{bad}, UsageError) << bad;
}

TEST(LeftOut, TurnsOffWhatBelongsToTheSettings) {
  RenderSettings settings;
  settings.environment.wetness = 0.5f;
  settings.environment.sky_cd_m2 = glm::vec3(0.01f);
  settings.environment.moon_lux = glm::vec3(0.2f);
  settings.indirect.bounces = 4;
  settings.air.visibility_km = 1;
  for (const ModelPart& part : list_model_parts()) {
    if (part.of_scene) continue;
    EXPECT_TRUE(is_present(part, {}, settings)) << part.name;
    LeftOut left_out;
    left_out.add(part);
    RenderSettings without = settings;
    left_out.apply(without);
    EXPECT_FALSE(is_present(part, {}, without)) << part.name;
    EXPECT_FALSE(have_same_estimate(without, settings)) << part.name;
  }
}

}  // namespace
}  // namespace nightcity::render
