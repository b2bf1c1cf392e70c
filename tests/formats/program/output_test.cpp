#include "formats/program/output.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "support/temp_folder.h"

namespace nightcity::program {
namespace {

using nightcity::test::TempFolder;

TEST(OutputOption, IsSpelledInThreeWays) {
  for (const char* spelling : {"-o", "--out", "--output"}) {
    CLI::App app;
    std::filesystem::path target;
    add_output_option(app, target, "A folder")->required();
    app.parse(std::string(spelling) + " results");
    EXPECT_EQ(target, "results");
  }
}

TEST(OutputOption, MayBeRepeatedForAList) {
  CLI::App app;
  std::vector<std::string> targets;
  add_output_option(app, targets, "Pictures");
  app.parse("-o a.png --out b.png --output c.exr");
  EXPECT_EQ(targets, (std::vector<std::string>{"a.png", "b.png", "c.exr"}));
}

TEST(WritableFolder, IsMadeWithItsParents) {
  const TempFolder folder;
  require_writable_folder(folder / "a/b/c");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b/c"));
  require_writable_folder(folder / "a/b/c");  // it exists now
  require_writable_folder_of(folder / "d/picture.png");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "d"));
  EXPECT_FALSE(std::filesystem::exists(folder / "d/picture.png"));
}

TEST(WritableFolder, LeavesNothingBehindWhereItFails) {
  const TempFolder folder;
  EXPECT_THROW(require_writable_folder(folder / "a/b" / std::string(300, 'x')), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  // A command fails later: its folders go where they are empty, and what holds files stays.
  require_writable_folder(folder / "c/d/");
  require_writable_folder(folder / "c/e");
  test::write_text(folder / "c/e/file", "text");
  remove_made_folders();
  EXPECT_FALSE(std::filesystem::exists(folder / "c/d"));
  EXPECT_TRUE(std::filesystem::exists(folder / "c/e/file"));
  require_writable_folder(folder / "f");
  keep_made_folders();
  remove_made_folders();
  EXPECT_TRUE(std::filesystem::exists(folder / "f"));
}

TEST(WritableFolder, IsNoFileAndNotBelowOne) {
  const TempFolder folder;
  EXPECT_THROW(require_writable_folder_of(folder.path()), Error);  // a file is to lie there
  test::write_text(folder / "file", "text");
  EXPECT_THROW(require_writable_folder(folder / "file"), Error);
  EXPECT_THROW(require_writable_folder(folder / "file/below"), Error);
  EXPECT_THROW(require_writable_folder_of(folder / "file/picture.png"), Error);
  EXPECT_THROW(require_writable_folder("/proc/self"), Error) << "nothing can be written there";
}

}  // namespace
}  // namespace nightcity::program
