#include "runtime/viewer/session.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <set>

#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::viewer {
namespace {

class Keys : public testing::Test {
 protected:
  void SetUp() override { session.open(start, folder / "city.cameras.json", 0); }

  WindowRequests press(int key, int modifiers = 0, Background background = Background::nothing) {
    const auto found = find_action(key, modifiers);
    return found ? session.press(*found, &scene, background, now_s) : WindowRequests{};
  }
  void fly(double seconds, double at_s) {
    session.move({.held_s = {0, 0, seconds}}, scene, {1280, 720}, at_s);
  }

  test::TempFolder folder;
  scene::RenderScene scene = test::SceneBuilder().ground(100).with({});
  scene::CameraPose start{{0, 15, 50}, {0, 15, 0}, {0, 1, 0}, 50};
  Session session;
  double now_s = 1;
};

TEST_F(Keys, EscapeClosesWhatIsOpenBeforeTheWindow) {
  press(GLFW_KEY_F1);
  EXPECT_TRUE(session.state.show_help);
  WindowRequests requests = press(GLFW_KEY_ESCAPE, 0, Background::picture);
  EXPECT_FALSE(session.state.show_help);
  EXPECT_FALSE(requests.close || requests.cancel_picture);
  requests = press(GLFW_KEY_ESCAPE, 0, Background::picture);
  EXPECT_TRUE(requests.cancel_picture);
  EXPECT_FALSE(requests.close);
  requests = press(GLFW_KEY_ESCAPE, 0, Background::film);
  EXPECT_TRUE(requests.stop_film);
  EXPECT_FALSE(requests.close);
  EXPECT_TRUE(press(GLFW_KEY_ESCAPE).close);
}

// Every key of the table, before there is a scene: those that need one leave everything as it is
// and say why; the others do what they do later.
TEST_F(Keys, WhileTheSceneIsOpenedThoseThatNeedItSayThatAndOthersAreObeyed) {
  const auto press_early = [&](const KeyPress& key) {
    return session.press(key, nullptr, Background::nothing, now_s);
  };
  for (const KeyBinding& key : list_keys()) {
    if (!key.needs_scene || key.action == Action::move) continue;  // those are held
    session.notices = {};
    const WindowRequests requests = press_early({key.action, 1});
    ASSERT_EQ(session.notices.lines().size(), 1u) << key.keys;
    EXPECT_EQ(session.notices.lines()[0].text,
              std::string(key.keys) + ": wait, the scene is still being opened");
    EXPECT_FALSE(requests.save_picture || requests.film || requests.record_path ||
                 requests.copy_camera || requests.paste_camera || requests.switch_light ||
                 requests.save_edits || requests.close)
        << key.keys;
  }
  EXPECT_EQ(session.state.camera.pose.position, start.position);
  EXPECT_EQ(session.count_bookmarks(), 0u);
  session.notices = {};
  press_early({Action::estimator, 2});
  EXPECT_EQ(session.state.settings.sampling.estimator, render::Estimator::ris);
  press_early({Action::panel});
  EXPECT_FALSE(session.state.show_panel);
  press_early({Action::play});
  EXPECT_TRUE(session.state.play);
  press_early({Action::next_view});
  EXPECT_EQ(session.state.settings.display.view, VIEW_LUMINANCE);
  press_early({Action::help});
  EXPECT_TRUE(session.state.show_help);
  EXPECT_FALSE(press_early({Action::close}).close) << "the help is closed first";
  EXPECT_TRUE(press_early({Action::fullscreen}).fullscreen);
  EXPECT_EQ(press_early({Action::smaller_text}).larger_text, -1);
  EXPECT_TRUE(press_early({Action::save_settings}).save_settings);
  EXPECT_TRUE(press_early({Action::close}).close);
  EXPECT_TRUE(session.notices.lines().empty());
}

// The picture is compared with its reference or with another picture, not with both; and the clock
// stands, so that both are of one time.
TEST_F(Keys, TheDifferenceToTheReferenceAndAComparisonExcludeEachOther) {
  session.toggle_comparison();
  session.show(find_view("difference"), 1);
  EXPECT_FALSE(session.state.compare.on);
  EXPECT_EQ(session.state.settings.display.view, VIEW_DIFFERENCE);
  EXPECT_GT(session.state.settings.display.view_lowest, 0) << "the next view's scale begins there";
  session.state.night_changes = session.state.play = true;
  EXPECT_FALSE(session.clock_runs());
  session.toggle_comparison();
  EXPECT_TRUE(session.state.compare.on);
  EXPECT_EQ(session.state.settings.display.view, VIEW_PICTURE);
  EXPECT_TRUE(session.clock_runs());
}

TEST_F(Keys, VShowsAllViewsOneAfterTheOther) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < VIEW_COUNT; ++i) {
    seen.insert(session.state.settings.display.view);
    press(GLFW_KEY_V);
  }
  EXPECT_EQ(seen.size(), VIEW_COUNT);
  EXPECT_EQ(session.state.settings.display.view, VIEW_PICTURE);
}

TEST_F(Keys, LightsAreEditedAndDistancesMeasuredFromWhatWasClicked) {
  EXPECT_TRUE(press(GLFW_KEY_O).switch_light);
  EXPECT_LT(press(GLFW_KEY_COMMA).brighten, 1);
  EXPECT_NEAR(press(GLFW_KEY_COMMA).brighten * press(GLFW_KEY_PERIOD).brighten, 1, 1e-12);
  EXPECT_TRUE(press(GLFW_KEY_E, GLFW_MOD_CONTROL).save_edits);
  EXPECT_FALSE(press(GLFW_KEY_E).save_edits);  // held to move
  EXPECT_TRUE(press(GLFW_KEY_S, GLFW_MOD_CONTROL).save_settings);
  press(GLFW_KEY_N);
  EXPECT_FALSE(session.measured_from);  // nothing was clicked
  session.picked = Pick{};
  session.picked->point = {1, 2, 3};
  press(GLFW_KEY_N);
  EXPECT_EQ(session.measured_from, glm::vec3(1, 2, 3));
  EXPECT_FALSE(press(GLFW_KEY_ESCAPE).close);  // first what was clicked, then the distance
  EXPECT_FALSE(session.picked);
  EXPECT_FALSE(press(GLFW_KEY_ESCAPE).close);
  EXPECT_FALSE(session.measured_from);
  EXPECT_TRUE(press(GLFW_KEY_ESCAPE).close);
}

TEST_F(Keys, TheOtherSideOfAComparisonKeepsItsSettingsAndTheClock) {
  EXPECT_TRUE(press(GLFW_KEY_X).compare);
  session.toggle_comparison();
  ASSERT_TRUE(session.state.compare.on);
  press(GLFW_KEY_2);
  EXPECT_EQ(session.state.compare.other.sampling.estimator, render::Estimator::traced);
  session.state.settings.display.ev100 = 7;
  session.change_side();
  EXPECT_EQ(session.state.settings.sampling.estimator, render::Estimator::traced);
  EXPECT_EQ(session.state.settings.display.ev100, 7);
  EXPECT_FALSE(session.state.compare.changes_b);
  session.change_side();
  EXPECT_EQ(session.state.settings.sampling.estimator, render::Estimator::ris);
  // One clock moves both; with two times it stands.
  session.state.night_changes = session.state.play = true;
  const double before_s = session.state.settings.time_s;
  session.run_clock(2, 0, 1);
  EXPECT_EQ(session.state.settings.time_s, before_s + 2);
  EXPECT_EQ(session.state.compare.other.time_s, before_s + 2);
  session.state.compare.other.time_s += 60;
  EXPECT_FALSE(session.clock_runs());
}

TEST_F(Keys, DigitsChooseEstimatorsAndOthersNothing) {
  press(GLFW_KEY_2);
  EXPECT_EQ(session.state.settings.sampling.estimator, render::Estimator::ris);
  press(GLFW_KEY_9);
  EXPECT_EQ(session.state.settings.sampling.estimator, render::Estimator::ris);
}

TEST_F(Keys, LettersWithControlAreOtherKeys) {
  EXPECT_FALSE(press(GLFW_KEY_C).copy_camera);
  EXPECT_TRUE(press(GLFW_KEY_C, GLFW_MOD_CONTROL).copy_camera);
  EXPECT_FALSE(find_action(GLFW_KEY_P, GLFW_MOD_CONTROL));
  EXPECT_FALSE(find_action(GLFW_KEY_W, 0));  // held to move
}

TEST_F(Keys, AMoveIsTakenBackAsAWhole) {
  for (int i = 0; i < 10; ++i) fly(0.1, 5 + 0.1 * i);
  for (int i = 0; i < 10; ++i) fly(0.1, 20 + 0.1 * i);
  EXPECT_NEAR(session.state.camera.pose.position.z, 30, 1e-3);
  press(GLFW_KEY_Z);
  EXPECT_NEAR(session.state.camera.pose.position.z, 40, 1e-3);
  press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  EXPECT_EQ(session.state.camera.pose.position, start.position);
  EXPECT_FALSE(session.can_undo());
  press(GLFW_KEY_Z);
  EXPECT_EQ(session.state.camera.pose.position, start.position);
}

TEST_F(Keys, TheCameraGoesThroughTextAndBack) {
  fly(1.234, 5);
  const scene::CameraPose there = session.state.camera.pose;
  const std::string text = scene::to_text(there);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  fly(3, 15);
  session.paste_camera(text, 20);
  EXPECT_EQ(session.state.camera.pose.position, there.position);
  EXPECT_EQ(session.state.camera.pose.target, there.target);
  EXPECT_EQ(scene::find_camera(text, scene).position, there.position);  // as --camera takes it
  for (const char* bad : {"", "hello", "{}", "{\"position\": [1,2,3], \"target\": [1,2,3]}"}) {
    session.paste_camera(bad, 30);
    EXPECT_EQ(session.state.camera.pose.position, there.position);
    EXPECT_TRUE(session.notices.lines().back().is_error);
  }
}

TEST_F(Keys, BookmarksLieBesideTheSceneAndArePathsToo) {
  press(GLFW_KEY_B);
  fly(1, 5);
  press(GLFW_KEY_B);
  const scene::CameraPose second = session.state.camera.pose;
  fly(1, 15);
  press(GLFW_KEY_F2);
  EXPECT_EQ(session.state.camera.pose.position, start.position);

  Session later;
  later.open(second, folder / "city.cameras.json", 0);
  EXPECT_EQ(later.count_bookmarks(), 2u);
  const auto key = find_action(GLFW_KEY_F3, 0);
  later.press(*key, &scene, Background::nothing, 1);
  EXPECT_EQ(later.state.camera.pose.position, second.position);
  const auto none = find_action(GLFW_KEY_F9, 0);
  later.press(*none, &scene, Background::nothing, 1);
  EXPECT_EQ(later.state.camera.pose.position, second.position);
}

TEST_F(Keys, BrokenBookmarksAreNamedAndNoEnd) {
  test::write_text(folder / "broken.cameras.json", "{\"poses\": 3}");
  session.open(start, folder / "broken.cameras.json", 0);
  EXPECT_EQ(session.count_bookmarks(), 0u);
  ASSERT_FALSE(session.notices.lines().empty());
  EXPECT_NE(session.notices.lines().back().text.find("broken.cameras.json"), std::string::npos);
}

TEST_F(Keys, WalkingBeginsOnTheGround) {
  press(GLFW_KEY_F);
  EXPECT_EQ(session.state.camera.motion, Motion::fly);
  press(GLFW_KEY_F);
  EXPECT_EQ(session.state.camera.motion, Motion::walk);
  EXPECT_NEAR(session.state.camera.pose.position.y, eye_height_m, 1e-4);
  press(GLFW_KEY_Z);
  EXPECT_EQ(session.state.camera.pose.position, start.position);
}

TEST_F(Keys, TheClockKeepsRealTimeAndBeginsTheNightAgainAloud) {
  session.state.night_changes = session.state.play = true;
  session.state.clock_speed = 60;
  session.state.settings.time_s = night_begin_s;
  session.run_clock(2.5, 0, 1);  // a slow frame counts in full
  EXPECT_NEAR(session.state.settings.time_s, night_begin_s + 150, 1e-9);
  session.run_clock(2.5, 0.5, 1);
  EXPECT_NEAR(session.state.settings.time_s, night_begin_s + 150.5, 1e-9);
  session.run_clock(1e6, 0, 1);
  EXPECT_EQ(session.state.settings.time_s, night_begin_s);
  EXPECT_FALSE(session.notices.lines().empty());
  session.state.play = false;
  session.run_clock(5, 0, 1);
  EXPECT_EQ(session.state.settings.time_s, night_begin_s);
}

TEST(KeyTable, EveryActionIsListedAndFound) {
  std::set<Action> listed, found;
  for (const KeyBinding& key : list_keys()) listed.insert(key.action);
  for (int key = 0; key <= GLFW_KEY_LAST; ++key)
    for (const int modifiers : {0, GLFW_MOD_CONTROL})
      if (const auto press = find_action(key, modifiers)) found.insert(press->action);
  listed.erase(Action::move);
  found.erase(Action::smaller_text);  // in one row with larger_text
  EXPECT_EQ(listed, found);
}

TEST(KeyTable, ThePageListsWhatTheTableSays) {
  const std::string page =
      test::read_text(std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "docs/window.md");
  const auto expect_row = [&](const std::string& name, const std::string& help) {
    const std::string row = "| " + name + " | " + help + " |";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  };
  for (const KeyBinding& key : list_keys()) expect_row(key.keys, key.help);
  for (const auto& [gesture, effect] : list_gestures()) expect_row(gesture, effect);
}

TEST(NoticeLines, StayForAWhileAndErrorsLonger) {
  Notices notices;
  notices.say("saved", 0);
  notices.say("failed", 0, true);
  notices.say("saved", 1);
  EXPECT_EQ(notices.lines().size(), 2u);
  EXPECT_NEAR(notices.next_change_s(1), 6, 1e-9);
  EXPECT_FALSE(notices.expire(6.5));
  EXPECT_TRUE(notices.expire(8));
  ASSERT_EQ(notices.lines().size(), 1u);
  EXPECT_EQ(notices.lines()[0].text, "failed");
  for (int i = 0; i < 20; ++i) notices.say(std::to_string(i), 8);
  EXPECT_LE(notices.lines().size(), 4u);
}

}  // namespace
}  // namespace nightcity::viewer
