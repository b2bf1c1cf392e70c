// Every archive kept by the fuzzer gives an Error or documents, never a crash.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string_view>

#include "support/corpus.h"
#include "tools/city/byte_source.h"

namespace nightcity::city {
namespace {

TEST(ArchiveCorpus, EveryFileIsReadOrRefused) {
  constexpr std::array<std::string_view, 3> endings{".gml", ".xml", ".json"};
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/inputs/corpus";
  std::size_t documents = 0;
  const auto files = test::read_each_file(corpus, 1, [&](const std::filesystem::path& file) {
    for (const Document& document : list_documents(file, endings)) {
      EXPECT_LE(read_start(document, 100).size(), 100u) << file;
      ++documents;
    }
  });
  EXPECT_GE(documents, 5u);
  EXPECT_GE(files.refused, 1u);
}

}  // namespace
}  // namespace nightcity::city
