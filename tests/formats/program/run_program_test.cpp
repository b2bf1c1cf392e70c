#include "formats/program/run_program.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <new>

#include "formats/error.h"

namespace nightcity::program {
namespace {

struct Outcome {
  int exit_code;
  std::string out, err;
};

// A program with one subcommand, `work`, whose callback is `work`.
Program make_program(std::function<void()> work) {
  Program program;
  program.name = "lamplighter";
  program.description = "lights lamps";
  program.version = "1.2.3";
  program.exit_codes = "0, 1 and 2.";
  program.add_commands = [work = std::move(work)](CLI::App& app) {
    app.add_subcommand("work", "Work")->callback(work);
  };
  return program;
}

Outcome run(const Program& program, std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), program.name.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int exit_code = run_program(program, static_cast<int>(arguments.size()), arguments.data());
  std::fflush(stderr);
  return {exit_code, testing::internal::GetCapturedStdout(),
          testing::internal::GetCapturedStderr()};
}

Outcome run_work(std::function<void()> work, std::vector<const char*> arguments = {"work"}) {
  return run(make_program(std::move(work)), std::move(arguments));
}

TEST(RunProgram, AnUnknownCommandIsNamedWithTheNearest) {
  const Outcome typo = run_work([] {}, {"wrok"});
  EXPECT_EQ(typo.exit_code, 2);
  EXPECT_NE(typo.err.find("there is no command \"wrok\"; did you mean \"work\"?"),
            std::string::npos)
      << typo.err;
  EXPECT_NE(run_work([] {}, {"work", "--bogus"}).err.find("--bogus"), std::string::npos);
  EXPECT_NE(run_work([] {}, {"-q"}).err.find("subcommand"), std::string::npos);
}

TEST(RunProgram, PrintsResultsToStdoutAndNothingElse) {
  const Outcome outcome = run_work([] { std::printf("42\n"); });
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "42\n");
  EXPECT_EQ(outcome.err, "");
}

TEST(RunProgram, PrintsHelpAndVersionAsResults) {
  const Outcome version = run_work([] { FAIL(); }, {"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out, "lamplighter 1.2.3\n");
  const Outcome help = run_work([] { FAIL(); }, {"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* part :
       {"lamplighter lights lamps", "work", "--version", "-v,--verbose", "Exit codes"})
    EXPECT_NE(help.out.find(part), std::string::npos) << part;
  EXPECT_EQ(version.err + help.err, "");
}

TEST(RunProgram, EndsEachExceptionAsOneLineWithItsExitCode) {
  const auto expect = [](std::function<void()> work, int exit_code, const std::string& message) {
    const Outcome outcome = run_work(std::move(work));
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_EQ(outcome.err, "lamplighter: error: " + message + "\n");
    EXPECT_EQ(outcome.out, "");
  };
  expect([] { throw Error("lamps.osm", "is empty"); }, 1, "lamps.osm: is empty");
  expect([] { throw UsageError("--ev", "is no number"); }, 2, "--ev: is no number");
  expect([] { throw std::bad_alloc(); }, 1, "out of memory");
  expect([] { throw std::runtime_error("disk on fire"); }, 1, "disk on fire");
  expect([] { throw 42; }, 1, "an unknown exception ended the work");
}

TEST(RunProgram, CallsAWrongCommandLineWrong) {
  for (const auto& arguments : std::vector<std::vector<const char*>>{
           {}, {"play"}, {"work", "--harder"}, {"work", "--verbose", "--quiet"}}) {
    const Outcome outcome = run_work([] { FAIL(); }, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("(see lamplighter --help)\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(RunProgram, TakesLevelsOfMessagesBeforeAndAfterTheSubcommand) {
  const auto count_lines = [](std::vector<const char*> arguments) {
    const std::string err = run_work(
                                [] {
                                  spdlog::debug("a detail");
                                  spdlog::info("a message");
                                  spdlog::error("an error");
                                },
                                std::move(arguments))
                                .err;
    return std::count(err.begin(), err.end(), '\n');
  };
  EXPECT_EQ(count_lines({"work"}), 2);
  EXPECT_EQ(count_lines({"work", "-v"}), 3);
  EXPECT_EQ(count_lines({"--verbose", "work"}), 3);
  EXPECT_EQ(count_lines({"work", "--quiet"}), 1);
  EXPECT_EQ(count_lines({"-q", "work"}), 1);
  EXPECT_EQ(count_lines({"work"}), 2) << "one run leaves no level to the next";
}

TEST(RunProgram, LetsTheProgramCompleteItsArguments) {
  bool has_worked = false;
  Program program = make_program([&has_worked] { has_worked = true; });
  program.complete_arguments = [](const CLI::App&, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "work");
    return arguments;
  };
  EXPECT_EQ(run(program, {"-q"}).exit_code, 0);
  EXPECT_TRUE(has_worked);
}

}  // namespace
}  // namespace nightcity::program
