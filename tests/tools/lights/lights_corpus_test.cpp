// Every file kept by the fuzzers of luminaires and tags is sound, or refused with a reason.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/temp_folder.h"
#include "tests/tools/lights/sound_luminaire.h"
#include "tests/tools/lights/sound_tags.h"

namespace nightcity::lights {
namespace {

const std::filesystem::path tests = NIGHTCITY_SOURCE_DIR "/tests/tools/lights";

TEST(LightsCorpus, EveryLuminaireIsReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests / "corpus")) {
    ++files;
    EXPECT_EQ(test::find_fault_of_luminaire(entry.path()), "") << entry.path();
  }
  EXPECT_GE(files, 8u);
}

TEST(LightsCorpus, EveryTagIsReadOrPassedOver) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests / "corpus_tags")) {
    ++files;
    EXPECT_EQ(test::find_fault_of_tags(test::read_text(entry.path())), "") << entry.path();
  }
  EXPECT_GE(files, 4u);
}

}  // namespace
}  // namespace nightcity::lights
