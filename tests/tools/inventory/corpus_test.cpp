// Every file kept by the fuzzer gives an Error or lamps, never a crash.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/corpus.h"
#include "tests/tools/inventory/sound_inventory.h"

namespace nightcity::inventory {
namespace {

TEST(InventoryCorpus, EveryFileIsReadOrRefused) {
  test::expect_sound_files(NIGHTCITY_SOURCE_DIR "/tests/tools/inventory/corpus", 6,
                           test::find_fault_of_inventory);
}

}  // namespace
}  // namespace nightcity::inventory
