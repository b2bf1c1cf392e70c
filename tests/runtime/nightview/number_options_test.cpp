// Every option of every command that takes a number refuses what is no usable number.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "runtime/experiments/sweep_points.h"
#include "support/process.h"

namespace nightcity::nightview {
namespace {

struct NumberOption {
  std::string name;      // the name that messages use
  std::string spelling;  // that name or an older one
  bool is_whole;
};

std::vector<std::string> list_commands() {
  return {"render",     "view",     "compare", "bench",   "upward", "sweep",
          "strategies", "vehicles", "flight",  "devices", "record", "price"};
}

// Finds the options in the command's own help, so that a new one is tested without being named
// here.
std::vector<NumberOption> find_number_options(const std::string& command) {
  std::istringstream help(test::run_program("nightview", command + " --help").out);
  const std::regex option(R"(^\s+((?:-\w,)?--[\w-]+(?:,--[\w-]+)*) (UINT|INT|FLOAT)\b.*)");
  std::vector<NumberOption> found;
  std::smatch match;
  for (std::string line; std::getline(help, line);) {
    if (!std::regex_match(line, match, option)) continue;
    std::istringstream names(match[1]);
    std::string first;
    for (std::string name; std::getline(names, name, ',');) {
      if (name.starts_with("--") && first.empty()) first = name;
      found.push_back({first, name, match[2] != "FLOAT"});
    }
  }
  return found;
}

// Arguments that a command needs. None of the files exists: an option that is accepted ends with
// exit code 1, or renders.
std::string required_arguments(const std::string& command, const test::TempFolder& folder) {
  const std::string out = " --out" + test::quoted(folder / "out");
  if (command == "compare") return " none.exr none.exr ";
  if (command == "render") return " none.glb --out" + test::quoted(folder / "a.png");
  if (command == "sweep" || command == "flight" || command == "upward") return " none.glb" + out;
  if (command == "record") return " none.glb --path orbit" + out;
  if (command == "strategies") return out + "--lights 1 --size 1x1 --frames 1 ";
  if (command == "vehicles") return " --vehicles 0 --lamps 1 --size 1x1 --frames 1 ";
  if (command == "devices") return "";
  return " none.glb ";
}

class NumberOptions : public testing::TestWithParam<std::string> {};

TEST_P(NumberOptions, RefuseNanInfinityAndNumbersOutOfRange) {
  const test::TempFolder folder;
  const std::string command = GetParam();
  const std::vector<NumberOption> options = find_number_options(command);
  EXPECT_EQ(options.empty(), command == "devices");
  for (const NumberOption& option : options) {
    const std::vector<std::string> words =
        option.is_whole
            ? std::vector<std::string>{"nan", "-1", "0.5x", "0x10", "010", "' 5'", "'5 '"}
            : std::vector<std::string>{"nan",  "-nan",   "inf", "-1e39",  "1e39",
                                       "0.5x", "0x1p-1", "+-1", "' 0.5'", "'0.5 '"};
    for (const std::string& word : words) {
      const std::string arguments = required_arguments(command, folder);
      // The option comes last: where it repeats one of the required ones, both are refused
      // together.
      const test::Outcome outcome = test::run_program(
          "nightview", "-q " + command + arguments + option.spelling + "=" + word);
      EXPECT_EQ(outcome.exit_code, 2) << command << " " << option.spelling << " " << word;
      EXPECT_NE(outcome.err.find(option.name), std::string::npos)
          << command << " " << option.spelling << " " << word << ": " << outcome.err;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, NumberOptions, testing::ValuesIn(list_commands()),
                         [](const auto& parameter) { return parameter.param; });

TEST(NumberOptions, ListsOfTheSweepRefuseNan) {
  const test::TempFolder folder;
  for (const render::Setting& setting : experiments::list_swept_settings()) {
    const test::Outcome outcome =
        test::run_program("nightview", "-q sweep none.glb --out" + test::quoted(folder / "out") +
                                           render::option_of(setting) + " nan");
    EXPECT_EQ(outcome.exit_code, 2) << setting.name;
    EXPECT_NE(outcome.err.find(render::option_of(setting)), std::string::npos) << outcome.err;
  }
}

TEST(NumberOptions, TextsThatHoldNumbersRefuseNan) {
  const test::TempFolder folder;
  for (const std::string option : {"--ev nan", "--moon nan,nan", "--moon 10,20,nan", "--time nan",
                                   "--time 20:00:nan", "--size nanx1", "--near-share nan"})
    EXPECT_EQ(test::run_program("nightview",
                                "-q render none.glb -o" + test::quoted(folder / "a.png") + option)
                  .exit_code,
              2)
        << option;
}

}  // namespace
}  // namespace nightcity::nightview
