// Every settings file that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include "tests/runtime/render/sound_settings.h"

namespace nightcity::render {
namespace {

const auto settings_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/render/corpus";

TEST(SettingsCorpus, EveryFileIsReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(settings_corpus)) {
    EXPECT_EQ(test::find_fault_of_settings(entry.path()), "") << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3u);
}

TEST(SettingsCorpus, HoldsAWholeFileOfEverySetting) {
  const SettingsFile file = read_settings_file(settings_corpus / "everything.toml");
  EXPECT_GE(file.render.size(), 20u);
  EXPECT_GE(file.window.size(), 2u);
}

}  // namespace
}  // namespace nightcity::render
