#include "formats/small_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "formats/error.h"
#include "support/temp_folder.h"

namespace nightcity::test {
namespace {

std::string refusal_of(const std::filesystem::path& path) {
  try {
    read_small_file(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

TEST(SmallFile, IsReadWhole) {
  const TempFolder folder;
  const std::string text("a\0b\n", 4);
  write_text(folder / "a", text);
  EXPECT_EQ(read_small_file(folder / "a"), text);
  EXPECT_EQ(read_small_file(folder / "a", 4), text);
  EXPECT_THROW(read_small_file(folder / "a", 3), Error);
  write_text(folder / "empty", "");
  EXPECT_EQ(read_small_file(folder / "empty"), "");
}

// A file of holes is as long as anybody likes and takes no room on the disk.
TEST(SmallFile, IsRefusedWhereItIsLargeOrNoFile) {
  const TempFolder folder;
  write_text(folder / "holes", "");
  std::filesystem::resize_file(folder / "holes", std::uintmax_t{20} << 30);
  EXPECT_NE(refusal_of(folder / "holes").find("67108864 at most"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal_of(folder / "pipe").find("not a regular file"), std::string::npos);
  EXPECT_NE(refusal_of(folder / "absent").find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal_of(folder / "").find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::test
