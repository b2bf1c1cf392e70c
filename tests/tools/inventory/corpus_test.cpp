// Every file kept by the fuzzer gives an Error or lamps, never a crash.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/tools/inventory/sound_inventory.h"

namespace nightcity::inventory {
namespace {

TEST(InventoryCorpus, EveryFileIsReadOrRefused) {
  std::size_t files = 0;
  const std::filesystem::path corpus = NIGHTCITY_SOURCE_DIR "/tests/tools/inventory/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    ++files;
    EXPECT_EQ(test::find_fault_of_inventory(entry.path()), "") << entry.path();
  }
  EXPECT_GE(files, 6u);
}

}  // namespace
}  // namespace nightcity::inventory
