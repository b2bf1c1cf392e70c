// Every outline that the fuzzer starts from or has found, triangulated in each test run.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/corpus.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nightcity::streets {
namespace {

TEST(Corpus, EveryOutlineIsTriangulated) {
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/streets/corpus";
  test::feed_each_file(corpus, 3, LLVMFuzzerTestOneInput);
}

}  // namespace
}  // namespace nightcity::streets
