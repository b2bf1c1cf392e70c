#include "runtime/viewer/path_recorder.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "runtime/scene/camera_path.h"
#include "runtime/viewer/measured.h"
#include "runtime/viewer/window_settings.h"
#include "support/temp_folder.h"

namespace nightcity::viewer {
namespace {

// The camera moves 1 m a second; frames come irregularly.
TEST(PathRecorder, KeepsAPoseForEachIntervalOfTime) {
  const test::TempFolder folder;
  PathRecorder recorder;
  recorder.follow({}, 1);
  EXPECT_EQ(recorder.duration_s(), 0);
  recorder.start(10);
  for (const double t : {0.0, 0.1, 0.3, 0.9, 1.0, 2.6})
    recorder.follow({{float(t), 0, 0}, {float(t), 0, -10}, {0, 1, 0}, 60}, 10 + t);
  EXPECT_NEAR(recorder.duration_s(), 2.5, 1e-9);
  const std::string sentence = recorder.finish(folder / "city.glb");
  EXPECT_NE(sentence.find("city.path-001.json"), std::string::npos) << sentence;
  const auto poses = scene::read_poses(folder / "city.path-001.json", glm::dvec3(0));
  ASSERT_EQ(poses.size(), 11u);
  EXPECT_EQ(poses[0].position.x, 0);
  EXPECT_NEAR(poses[4].position.x, 1, 1e-6);
  EXPECT_NEAR(poses[10].position.x, 2.6, 1e-6);
  EXPECT_FALSE(recorder.is_recording());
  recorder.start(0);
  EXPECT_THROW(recorder.finish(folder / "city.glb"), Error);
  recorder.start(0);
  recorder.follow({}, 5);
  EXPECT_NE(recorder.finish(folder / "city.glb").find("path-002"), std::string::npos);
}

TEST(Measured, DistancesHaveTheirLevelAndVerticalParts) {
  EXPECT_EQ(describe_distance({1, 1, 1}, {4, 13, 5}), "13.00 m (5.00 m level, 12.00 m up)");
  EXPECT_EQ(describe_distance({0, 2, 0}, {0, 0, 0}), "2.00 m (0.00 m level, 2.00 m down)");
}

TEST(WindowSettings, AreReadAsEveryCommandReadsThem) {
  const test::TempFolder folder;
  ViewerState state;
  state.settings.sampling.candidates = 7;
  state.settings.indirect.bounces = 0;
  state.settings.environment.lights = scene::to_set(LightFamily::lamp);
  state.settings.time_s = 11 * 3600;
  state.auto_exposure = false;
  state.settings.display.ev100 = 3.25f;
  state.settings.display.view = VIEW_KINDS;
  state.divisor = 4;
  write_settings(folder / "s.toml", state);
  const render::SettingsFile file = render::read_settings_file(folder / "s.toml");
  EXPECT_EQ(file.find("candidates")->text, "7");
  EXPECT_EQ(file.find("bounces")->text, "0");
  EXPECT_EQ(file.find("lights")->text, "lamp");
  EXPECT_EQ(file.find("time")->text, "23:00:00");
  EXPECT_EQ(file.find("ev")->text, "3.25");
  EXPECT_EQ(file.find("neighbours"), nullptr);  // the default
  EXPECT_EQ(find_window_value(file, "show"), "kinds-of-light");
  EXPECT_EQ(parse_divisor(find_window_value(file, "every")), 4);
  EXPECT_EQ(find_window_value(file, "nothing"), "");
  EXPECT_THROW(parse_divisor("3"), UsageError);
  EXPECT_THROW(parse_divisor("-1"), UsageError);
}

}  // namespace
}  // namespace nightcity::viewer
