// Every archive kept by the fuzzer gives an Error or documents, never a crash.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "tools/city/byte_source.h"

namespace nightcity::city {
namespace {

TEST(ArchiveCorpus, EveryFileIsReadOrRefused) {
  constexpr std::array<std::string_view, 3> endings{".gml", ".xml", ".json"};
  std::size_t documents = 0, refused = 0;
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/inputs/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    try {
      for (const Document& document : list_documents(entry.path(), endings)) {
        EXPECT_LE(read_start(document, 100).size(), 100u) << entry.path();
        ++documents;
      }
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "") << entry.path();
      ++refused;
    }
  }
  EXPECT_GE(documents, 5u);
  EXPECT_GE(refused, 1u);
}

}  // namespace
}  // namespace nightcity::city
