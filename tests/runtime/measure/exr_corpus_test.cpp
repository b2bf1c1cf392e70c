// Every OpenEXR picture that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include "support/corpus.h"
#include "tests/runtime/measure/sound_exr.h"

namespace nightcity::measure {
namespace {

const auto exr_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/measure/corpus";

TEST(ExrCorpus, EveryPictureIsReadOrRefused) {
  test::expect_sound_files(exr_corpus, 4, test::find_fault_of_exr);
}

TEST(ExrCorpus, HoldsWholePictures) {
  const Image layered = read_exr(exr_corpus / "layers.exr");
  EXPECT_GE(layered.layers.size(), 2u);
  for (const char* name : {"tiled.exr", "grey.exr"})
    EXPECT_GE(read_exr(exr_corpus / name).pixels(), 4u);
}

}  // namespace
}  // namespace nightcity::measure
