// Every OpenEXR picture that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include "tests/runtime/measure/sound_exr.h"

namespace nightcity::measure {
namespace {

const auto exr_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/measure/corpus";

TEST(ExrCorpus, EveryPictureIsReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(exr_corpus)) {
    EXPECT_EQ(test::find_fault_of_exr(entry.path()), "") << entry.path();
    ++files;
  }
  EXPECT_GE(files, 4u);
}

TEST(ExrCorpus, HoldsWholePictures) {
  const Image layered = read_exr(exr_corpus / "layers.exr");
  EXPECT_GE(layered.layers.size(), 2u);
  for (const char* name : {"tiled.exr", "grey.exr"})
    EXPECT_GE(read_exr(exr_corpus / name).pixels(), 4u);
}

}  // namespace
}  // namespace nightcity::measure
