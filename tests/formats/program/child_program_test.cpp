#include "formats/program/child_program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "support/temp_folder.h"

namespace nightcity::program {
namespace {

TEST(ChildProgram, GivesItsOutputAndHowItEnded) {
  const auto said = run_child({"sh", "-c", "printf 'a b'; exit 3"}, true);
  ASSERT_TRUE(said);
  EXPECT_EQ(said->output, "a b");
  EXPECT_EQ(WEXITSTATUS(said->status), 3);
  const auto killed = run_child({"sh", "-c", "kill -KILL $$"}, false);
  ASSERT_TRUE(killed);
  EXPECT_TRUE(WIFSIGNALED(killed->status));
  EXPECT_FALSE(run_child({"/no/such/program"}, true));
}

// Arguments are the child's as they are: no shell reads them.
TEST(ChildProgram, TakesItsArgumentsAsTheyAre) {
  const auto said = run_child({"printf", "%s|", "$HOME", "a b", "`id`"}, true);
  ASSERT_TRUE(said);
  EXPECT_EQ(said->output, "$HOME|a b|`id`|");
}

// Waits without asking more often than a window would.
int wait_for(ChildProgram& child) {
  std::optional<int> status;
  while (!(status = child.find_status())) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return *status;
}

TEST(ChildProgram, RunsBesideThisOneAndIsReadMeanwhile) {
  const test::TempFolder folder;
  const std::string go = (folder / "go").string();
  ChildProgram child({"sh", "-c",
                      "echo one; until test -e '" + go +
                          "'; do sleep 0.01; done; "
                          "echo two >&2; exit 5"});
  while (child.read_output() != "one\n") std::this_thread::yield();
  EXPECT_FALSE(child.find_status());
  test::write_text(go, "");
  EXPECT_EQ(WEXITSTATUS(wait_for(child)), 5);
  EXPECT_EQ(child.read_output(), "one\n");
  EXPECT_EQ(child.read_messages(), "two\n");
  EXPECT_EQ(WEXITSTATUS(*child.find_status()), 5) << "asked again";
}

TEST(ChildProgram, IsStoppedAndEndsWithTheObject) {
  ChildProgram child({"sleep", "600"});
  child.stop();
  EXPECT_EQ(WTERMSIG(wait_for(child)), SIGTERM);
  { const ChildProgram other({"sleep", "600"}); }  // or the test takes ten minutes
  ChildProgram none({"/no/such/program"});
  EXPECT_EQ(WEXITSTATUS(wait_for(none)), 127);
}

// A program that is killed leaves none behind that it has started.
TEST(ChildProgram, EndsWithTheProgramThatStartedIt) {
  const test::TempFolder folder;
  const std::string mark = (folder / "pid").string();
  const pid_t parent = ::fork();
  if (parent == 0) {
    run_child({"sh", "-c", "echo $$ >'" + mark + "'; exec sleep 600"}, true);
    ::_exit(0);
  }
  std::string number;
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
  while (number.empty() || number.back() != '\n') {
    wait();
    if (std::filesystem::exists(mark)) number = test::read_text(mark);
  }
  const pid_t child = std::stoi(number);
  EXPECT_EQ(::kill(child, 0), 0);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  // The system may keep it as a dead process until somebody asks how it ended.
  const auto lives = [&] {
    const std::string stat = "/proc/" + number.substr(0, number.size() - 1) + "/stat";
    if (::kill(child, 0) != 0 || !std::filesystem::exists(stat)) return false;
    const std::string text = test::read_text(stat);
    return text.find(") Z") == std::string::npos;
  };
  for (int i = 0; i < 6000 && lives(); ++i) wait();
  EXPECT_FALSE(lives());
}

}  // namespace
}  // namespace nightcity::program
