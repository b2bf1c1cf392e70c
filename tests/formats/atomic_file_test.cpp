#include "formats/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "support/file_limit.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

void write_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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

TEST(ScratchFile, HasNoNameAndNeedsNoRoomBesideADevice) {
  const TempFolder folder;
  ScratchFile beside(folder / "a"), device("/dev/null");
  for (ScratchFile* file : {&beside, &device}) {
    file->write("text", 4);
    char back[4];
    file->read(0, back, 4);
    EXPECT_EQ(std::string_view(back, 4), "text");
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(ScratchFolder, IsTmpdirWhichMustBeThere) {
  const TempFolder folder;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  EXPECT_EQ(scratch_folder(), folder.path());
  ::setenv("TMPDIR", (folder / "absent").c_str(), 1);
  const std::string message = message_of([] { scratch_folder(); });
  if (before)
    ::setenv("TMPDIR", kept.c_str(), 1);
  else
    ::unsetenv("TMPDIR");
  EXPECT_NE(message.find("absent"), std::string::npos);
  EXPECT_NE(message.find("TMPDIR"), std::string::npos);
}

// Returns the wait status of a child that installs the handlers and runs `action`.
int status_of_child(const std::function<void()>& action, int output = -1) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (output >= 0) ::dup2(output, STDERR_FILENO);
    install_signal_handlers("test");
    action();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(Signals, RemoveWhatIsLeftAndStillEndTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    const TempFolder folder;
    const int status = status_of_child([&] {
      fs::create_directories(folder / "made/below");
      fs::create_directory(folder / "shared");
      test::write_text(folder / "made/below/file", "x");
      test::write_text(folder / "shared/another", "x");
      // Parents may come after what lies in them.
      const Leftover file(folder / "made/below/file", Leftover::Kind::file),
          below(folder / "made/below", Leftover::Kind::folder),
          made(folder / "made", Leftover::Kind::folder),
          shared(folder / "shared", Leftover::Kind::folder);
      ::raise(signal);
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_FALSE(fs::exists(folder / "made"));
    EXPECT_TRUE(fs::exists(folder / "shared/another"));
  }
}

TEST(Signals, WaitForWhatMustNotBeTornApart) {
  const TempFolder folder;
  const int status = status_of_child([&] {
    const SignalHold hold;
    ::raise(SIGTERM);
    test::write_text(folder / "after", "x");
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
  EXPECT_TRUE(fs::exists(folder / "after"));
}

TEST(Signals, RemoveWhatAnotherThreadMakesMeanwhile) {
  for (int run = 0; run < 20; ++run) {
    const TempFolder folder;
    const int status = status_of_child([&] {
      fs::create_directory(folder / "made");
      const Leftover made(folder / "made", Leftover::Kind::folder);
      std::thread([&] {
        for (;;) {
          Leftover file;
          {
            const SignalHold hold;
            test::write_text(folder / "made/file", "x");
            file = Leftover(folder / "made/file", Leftover::Kind::file);
          }
          ::unlink((folder / "made/file").c_str());
        }
      }).detach();
      ::usleep(500);
      ::raise(SIGTERM);
      ::pause();
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_FALSE(fs::exists(folder / "made"));
  }
}

TEST(Signals, StayIgnoredWhereTheyWere) {
  const int status = status_of_child([] {
    ::signal(SIGHUP, SIG_IGN);
    install_signal_handlers("test");
    ::raise(SIGHUP);
  });
  // The first installation came before; nohup sets it before the program begins, as here before the
  // second.
  EXPECT_TRUE(WIFEXITED(status));
}

TEST(Signals, AFileCutShortWhileItIsReadIsAMessage) {
  const TempFolder folder;
  test::write_text(folder / "mapped", std::string(1 << 20, 'x'));
  const int output = ::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0600);
  const int status = status_of_child(
      [&] {
        const MappedFile file(folder / "mapped");
        fs::resize_file(folder / "mapped", 0);
        volatile std::byte byte = file.bytes()[1 << 19];
        (void)byte;
      },
      output);
  ::close(output);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(ExitCode::bad_data));
  const std::string message = test::read_text(folder / "err");
  EXPECT_TRUE(message.starts_with("test: error: ")) << message;
  EXPECT_NE(message.find("mapped"), std::string::npos) << message;
}

TEST(MappedFile, RefusesAFifoAtOnce) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_NE(message_of([&] { MappedFile file(folder / "fifo"); }).find("is not a regular file"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity
