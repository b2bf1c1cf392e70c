#include "formats/program/nearest_word.h"

#include <gtest/gtest.h>

namespace nightcity::program {
namespace {

TEST(NearestWord, FindsTyposAndKeepsSilentOtherwise) {
  const std::vector<std::string> words{"files", "crs", "tile_m", "licence"};
  EXPECT_EQ(find_nearest_word("flies", words), "files");
  EXPECT_EQ(find_nearest_word("file", words), "files");
  EXPECT_EQ(find_nearest_word("license", words), "licence");
  EXPECT_EQ(find_nearest_word("tilem", words), "tile_m");
  EXPECT_EQ(find_nearest_word("atmosphere", words), "");
}

}  // namespace
}  // namespace nightcity::program
