#include "formats/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/file_limit.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TempFolder;

void write_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

TEST(AtomicFile, IsThereWhenCommittedAndNotBefore) {
  const TempFolder folder;
  test::write_text(folder / "a", "old");
  {
    AtomicFile file(folder / "a");
    file.write("new");
    EXPECT_EQ(test::read_text(folder / "a"), "old");
  }
  EXPECT_EQ(test::read_text(folder / "a"), "old");
  write_file(folder / "a", "new");
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, HasNoNameUntilItIsWhole) {
  const TempFolder folder;
  AtomicFile file(folder / "a");
  file.write(std::string(1 << 20, 'x'));
  // A kill would leave what is in the folder now. (Temporary folders are on file systems with
  // O_TMPFILE.)
  EXPECT_EQ(folder.entries(), 0u);
  file.commit();
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, FollowsTheUsersMask) {
  const TempFolder folder;
  const mode_t before = ::umask(027);
  write_file(folder / "a", "x");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(AtomicFile, FollowsLinksAndLeavesThem) {
  const TempFolder folder;
  fs::create_directory(folder / "elsewhere");
  test::write_text(folder / "elsewhere/file", "old");
  fs::create_symlink("elsewhere/file", folder / "link");
  fs::create_symlink("link", folder / "chain");
  fs::create_symlink("elsewhere/new", folder / "dangling");
  write_file(folder / "chain", "new");
  write_file(folder / "dangling", "made");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "chain"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
  EXPECT_EQ(test::read_text(folder / "elsewhere/file"), "new");
  EXPECT_EQ(test::read_text(folder / "elsewhere/new"), "made");
}

TEST(AtomicFile, LinksThatGoRoundAreAnError) {
  const TempFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_NE(message_of([&] { write_file(folder / "a", "x"); }), "");
  EXPECT_TRUE(fs::is_symlink(folder / "a"));
  EXPECT_TRUE(fs::is_symlink(folder / "b"));
}

TEST(AtomicFile, DevicesAreWrittenIntoAndStayDevices) {
  write_file("/dev/null", "gone");
  EXPECT_EQ(fs::status("/dev/null").type(), fs::file_type::character);
  const TempFolder folder;
  fs::create_symlink("/dev/null", folder / "link");
  write_file(folder / "link", "gone");
  EXPECT_EQ(fs::status("/dev/null").type(), fs::file_type::character);
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

TEST(AtomicFile, AFullDeviceIsAnErrorAndStaysADevice) {
  const std::string message = message_of([] { write_file("/dev/full", "x"); });
  EXPECT_NE(message.find("/dev/full"), std::string::npos) << message;
  EXPECT_NE(message.find("No space left"), std::string::npos) << message;
  EXPECT_EQ(fs::status("/dev/full").type(), fs::file_type::character);
}

TEST(AtomicFile, AWriteThatFailedIsNotForgotten) {
  const TempFolder folder;
  AtomicFile file(folder / "a");
  file.write(std::string(1000, 'x'));
  {
    const test::FileLimit limit(100);
    EXPECT_THROW(file.write_at(0, "y", 1), Error);
  }
  EXPECT_NE(message_of([&] { file.commit(); }).find("File too large"), std::string::npos);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(AtomicFile, AFifoGetsTheBytesAndStays) {
  const TempFolder folder;
  const fs::path fifo = folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = test::read_text(fifo); });
  const std::string text(300'000, 'x');  // more than a pipe holds
  write_file(fifo, text);
  reader.join();
  EXPECT_EQ(got, text);
  EXPECT_TRUE(fs::is_fifo(fifo));
}

TEST(AtomicFile, FoldersAreRefused) {
  const TempFolder folder;
  EXPECT_NE(message_of([&] { AtomicFile file(folder.path()); }).find("is a folder"),
            std::string::npos);
  EXPECT_NE(message_of([&] { AtomicFile file(folder / "absent/a"); }), "");
}

TEST(AtomicPath, GivesALibraryANameOfItsOwn) {
  const TempFolder folder;
  test::write_text(folder / "a", "old");
  test::write_text(folder / "a.part", "another's");
  fs::path scratch;
  {
    AtomicPath file(folder / "a");
    scratch = file.scratch();
    test::write_text(scratch, "unfinished");
  }
  EXPECT_FALSE(fs::exists(scratch));
  EXPECT_EQ(test::read_text(folder / "a"), "old");
  AtomicPath file(folder / "a");
  test::write_text(file.scratch(), "new");
  file.commit();
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  EXPECT_EQ(test::read_text(folder / "a.part"), "another's");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(AtomicPath, WritesIntoADevice) {
  AtomicPath file("/dev/null");
  test::write_text(file.scratch(), "gone");
  file.commit();
  EXPECT_EQ(fs::status("/dev/null").type(), fs::file_type::character);
}

}  // namespace
}  // namespace nightcity
