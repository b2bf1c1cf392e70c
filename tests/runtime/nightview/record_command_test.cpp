// nightview record as its users meet it.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "runtime/measure/png.h"
#include "support/process.h"
#include "support/scene_files.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::nightview {
namespace {

namespace fs = std::filesystem;

class RecordCommand : public testing::Test {
 protected:
  void SetUp() override {
    test::SceneBuilder builder = test::random_town(10, 40, 7);
    Georeference place;
    place.licences = {"Somebody's data"};
    test::write_scene_files(folder / "town.glb", builder.scene(), test::random_lamps(5, 30, 8),
                            place);
  }

  std::string arguments(const std::string& options = "", int frames = 2) const {
    return "record" + test::quoted(folder / "town.glb") + "--out" + test::quoted(folder / "film") +
           "--path orbit --size 24x16 --fps 4 --duration 1.5 --frames " + std::to_string(frames) +
           " " + options;
  }
  test::Outcome record(const std::string& options = "") const {
    return test::run_program("nightview", arguments(options));
  }
  fs::path picture(int i) const {
    return folder / ("film/frame-0000" + std::to_string(i) + ".png");
  }

  test::TempFolder folder;
};

TEST_F(RecordCommand, RendersAPictureForEachStepOfTimeWithItsDescription) {
  const test::Outcome outcome = record("--exr --clock-speed 60");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(measure::read_png(picture(i)).width, 24u) << i;
    EXPECT_TRUE(fs::exists(fs::path(picture(i)).replace_extension(".exr"))) << i;
  }
  EXPECT_FALSE(fs::exists(picture(6)));
  const std::string bytes = test::read_text(picture(4));
  EXPECT_NE(bytes.find("20:01:00"), std::string::npos);  // 60 times for a second
  EXPECT_NE(bytes.find("Somebody's data"), std::string::npos);
  EXPECT_NE(measure::read_png(picture(0)).rgb, measure::read_png(picture(5)).rgb);
}

TEST_F(RecordCommand, GoesOnWhereItWasAndLeavesOthersFoldersAlone) {
  ASSERT_EQ(record().exit_code, 0);
  const auto kept = fs::last_write_time(picture(2));
  fs::remove(picture(4));
  test::Outcome outcome = record();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 of them rendered now"), std::string::npos) << outcome.out;
  EXPECT_EQ(fs::last_write_time(picture(2)), kept);
  EXPECT_TRUE(fs::exists(picture(4)));
  outcome = record("--candidates 4");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("another recording"), std::string::npos) << outcome.err;
}

// A kill at any moment leaves whole pictures, and the same command makes the rest.
TEST_F(RecordCommand, SurvivesAKill) {
  const std::string line = std::string("exec '") + NIGHTCITY_BUILD_DIR + "/nightview' " +
                           arguments("", 20) + " > /dev/null 2>&1";
  for (int tries = 0; tries < 3; ++tries) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(400 + 300 * tries));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    for (int i = 0; i < 6; ++i) {
      if (fs::exists(picture(i))) {
        EXPECT_EQ(measure::read_png(picture(i)).height, 16u);
      }
    }
  }
  ASSERT_EQ(test::run_program("nightview", arguments("", 20)).exit_code, 0);
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(fs::exists(picture(i))) << i;
}

TEST_F(RecordCommand, MakesAFilmWithFfmpegAndSaysWhereThereIsNone) {
  fs::create_directory(folder / "bin");
  test::write_text(folder / "bin/ffmpeg",
                   "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n");
  fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
  const std::string before = ::getenv("PATH");
  const std::string film = "--film" + test::quoted(folder / "town.mp4");
  ::setenv("PATH", (folder / "bin").c_str(), 1);
  EXPECT_EQ(record(film).exit_code, 0);
  const std::string called = test::read_text(folder / "town.mp4");
  EXPECT_NE(called.find("-framerate 4 "), std::string::npos) << called;
  EXPECT_NE(called.find("film/frame-%05d.png"), std::string::npos) << called;
  fs::remove(folder / "bin/ffmpeg");
  fs::remove(folder / "town.mp4");
  const test::Outcome without = record(film);
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.err.find("not installed"), std::string::npos) << without.err;
  EXPECT_FALSE(fs::exists(folder / "town.mp4"));
  EXPECT_TRUE(fs::exists(picture(5)));
}

TEST_F(RecordCommand, WrongUsageEndsWith2BeforeAnyWork) {
  EXPECT_EQ(record("--fps nan").exit_code, 2);
  EXPECT_EQ(record("--ev bright").exit_code, 2);
  EXPECT_EQ(record("--duration 0").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "film"));
}

}  // namespace
}  // namespace nightcity::nightview
