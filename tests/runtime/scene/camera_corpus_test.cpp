// Every file of cameras that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include "support/corpus.h"
#include "support/temp_folder.h"
#include "tests/runtime/scene/sound_camera.h"

namespace nightcity::scene {
namespace {

const auto camera_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/scene/corpus";

TEST(CameraCorpus, EveryFileIsReadOrRefused) {
  test::expect_sound_files(camera_corpus, 3, [](const std::filesystem::path& file) {
    return test::find_fault_of_cameras(file, test::read_text(file));
  });
}

TEST(CameraCorpus, HoldsAWholePathAndAWholePose) {
  EXPECT_EQ(read_poses(camera_corpus / "path.json", glm::dvec3(0)).size(), 3u);
  EXPECT_EQ(parse_camera(test::read_text(camera_corpus / "pose.json"), "pose").fov_deg, 45);
}

}  // namespace
}  // namespace nightcity::scene
