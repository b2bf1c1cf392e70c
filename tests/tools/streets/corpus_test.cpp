// Every outline that the fuzzer starts from or has found, triangulated in each test run.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/temp_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nightcity::streets {
namespace {

TEST(Corpus, EveryOutlineIsTriangulated) {
  std::size_t files = 0;
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/streets/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    SCOPED_TRACE(entry.path());
    const std::string text = test::read_text(entry.path());
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    ++files;
  }
  EXPECT_GE(files, 3u);
}

}  // namespace
}  // namespace nightcity::streets
