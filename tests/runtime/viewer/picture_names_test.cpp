#include "runtime/viewer/picture_names.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <sys/wait.h>
#include <fstream>
#include <set>
#include <thread>

#include "formats/error.h"
#include "support/temp_folder.h"

namespace nightcity::viewer {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> both{".png", ".exr"};

void write_name(const fs::path& file, const std::string& extension) {
  std::ofstream(file) << extension;
}

std::size_t count_files(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(PictureNames, CountUpAndLeaveOthersAlone) {
  const test::TempFolder folder;
  EXPECT_EQ(save_under_next_name(folder.path(), both, write_name), "night-001");
  test::write_text(folder / "night-002.exr", "another's");
  EXPECT_EQ(save_under_next_name(folder.path(), both, write_name), "night-003");
  EXPECT_EQ(test::read_text(folder / "night-001.png"), ".png");
  EXPECT_EQ(test::read_text(folder / "night-002.exr"), "another's");
  EXPECT_EQ(count_files(folder.path()), 5u);
}

TEST(PictureNames, ALinkThatLeadsNowhereIsAName) {
  const test::TempFolder folder;
  fs::create_symlink("night-001.png", folder / "night-001.png");  // to itself
  EXPECT_EQ(save_under_next_name(folder.path(), both, write_name), "night-002");
}

// As two windows in one folder do: the temporary names tell processes apart, so each thread has its
// own folder for those, and the final names are claimed in the order of chance.
TEST(PictureNames, NobodyTakesAnothersName) {
  const test::TempFolder folder;
  const auto children = [&] {
    std::vector<pid_t> started;
    for (int i = 0; i < 4; ++i) {
      const pid_t child = ::fork();
      if (child == 0) {
        for (int k = 0; k < 25; ++k)
          save_under_next_name(folder.path(), both, [&](const fs::path& file, const std::string&) {
            std::ofstream(file) << ::getpid() << ' ' << k;
          });
        ::_exit(0);
      }
      started.push_back(child);
    }
    return started;
  }();
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(count_files(folder.path()), 200u);
  std::set<std::string> contents;
  for (int i = 1; i <= 100; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "night-%03d", i);
    const std::string png = test::read_text(folder / (std::string(name) + ".png"));
    EXPECT_EQ(png, test::read_text(folder / (std::string(name) + ".exr"))) << name;
    contents.insert(png);
  }
  EXPECT_EQ(contents.size(), 100u);
}

TEST(PictureNames, AFailureSaysWhyAndLeavesNothing) {
  const test::TempFolder folder;
  const auto fails = [](const fs::path& file, const std::string& extension) {
    write_name(file, extension);
    if (extension == ".exr") throw Error(file.string(), "disk full");
  };
  EXPECT_THROW(save_under_next_name(folder.path(), both, fails), Error);
  EXPECT_EQ(count_files(folder.path()), 0u);
}

TEST(PictureNames, AFolderThatMayNotBeSearchedIsAnErrorAndNoEnd) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may search every folder";
  const test::TempFolder folder;
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::none);
  EXPECT_THROW(save_under_next_name(folder / "closed", both, [](auto&&...) {}), Error);
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

TEST(PictureNames, AFolderThatIsNotThereIsNamed) {
  const test::TempFolder folder;
  try {
    save_under_next_name(folder / "missing", both, write_name);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos) << error.what();
  }
  EXPECT_EQ(find_picture_folder(folder / "missing"), folder / "missing");
}

}  // namespace
}  // namespace nightcity::viewer
