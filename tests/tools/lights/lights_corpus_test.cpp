// Every file kept by the fuzzers of luminaires and tags is sound, or refused with a reason.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/corpus.h"
#include "support/temp_folder.h"
#include "tests/tools/lights/sound_luminaire.h"
#include "tests/tools/lights/sound_tags.h"

namespace nightcity::lights {
namespace {

const std::filesystem::path tests = NIGHTCITY_SOURCE_DIR "/tests/tools/lights";

TEST(LightsCorpus, EveryLuminaireIsReadOrRefused) {
  test::expect_sound_files(tests / "corpus", 13, test::find_fault_of_luminaire);
}

TEST(LightsCorpus, EveryTagIsReadOrPassedOver) {
  test::expect_sound_files(tests / "corpus_tags", 4, [](const std::filesystem::path& file) {
    return test::find_fault_of_tags(test::read_text(file));
  });
}

}  // namespace
}  // namespace nightcity::lights
