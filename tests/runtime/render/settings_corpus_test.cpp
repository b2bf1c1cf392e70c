// Every settings file that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include "support/corpus.h"
#include "tests/runtime/render/sound_settings.h"

namespace nightcity::render {
namespace {

const auto settings_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/render/corpus";

TEST(SettingsCorpus, EveryFileIsReadOrRefused) {
  test::expect_sound_files(settings_corpus, 6, test::find_fault_of_settings);
}

TEST(SettingsCorpus, HoldsAWholeFileOfEverySetting) {
  const SettingsFile file = read_settings_file(settings_corpus / "everything.toml");
  EXPECT_GE(file.render.size(), 20u);
  EXPECT_GE(file.window.size(), 2u);
}

}  // namespace
}  // namespace nightcity::render
