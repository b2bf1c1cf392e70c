#include "formats/signals.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <thread>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

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

}  // namespace
}  // namespace nightcity
