// Every file of cameras that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include "support/temp_folder.h"
#include "tests/runtime/scene/sound_camera.h"

namespace nightcity::scene {
namespace {

const auto camera_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/scene/corpus";

TEST(CameraCorpus, EveryFileIsReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(camera_corpus)) {
    EXPECT_EQ(test::find_fault_of_cameras(entry.path(), test::read_text(entry.path())), "")
        << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3u);
}

TEST(CameraCorpus, HoldsAWholePathAndAWholePose) {
  EXPECT_EQ(read_poses(camera_corpus / "path.json", glm::dvec3(0)).size(), 3u);
  EXPECT_EQ(parse_camera(test::read_text(camera_corpus / "pose.json"), "pose").fov_deg, 45);
}

}  // namespace
}  // namespace nightcity::scene
