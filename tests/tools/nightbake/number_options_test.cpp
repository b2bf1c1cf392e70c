// Every option of every command that takes a number refuses what is no decimal number.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "support/process.h"

namespace nightcity::nightbake {
namespace {

std::vector<std::string> list_commands() {
  return {"run",    "price", "new",     "town",   "inspect", "lights",  "lamps",
          "layout", "merge", "windows", "export", "elevate", "traffic", "readers"};
}

class NumberOptions : public testing::TestWithParam<std::string> {};

// Options are found in the command's own help, so that a new one is tested without being named
// here.
TEST_P(NumberOptions, RefuseWhatIsNoDecimalNumber) {
  std::istringstream help(test::run_program("nightbake", GetParam() + " --help").out);
  const std::regex option(R"(^\s+(?:-\w,)?(--[\w-]+)\S* (UINT|INT|FLOAT)\b.*)");
  std::smatch match;
  for (std::string line; std::getline(help, line);) {
    if (!std::regex_match(line, match, option)) continue;
    const std::string name = match[1];
    for (const char* word : {"nan", "-nan", "inf", "0.5x", "0x10", "' 5'", "'5 '", "+-1"}) {
      const test::Outcome outcome =
          test::run_program("nightbake", "-q " + GetParam() + " " + name + "=" + word);
      EXPECT_EQ(outcome.exit_code, 2) << GetParam() << " " << name << " " << word;
      EXPECT_NE(outcome.err.find(name), std::string::npos)
          << GetParam() << " " << name << " " << word << ": " << outcome.err;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, NumberOptions, testing::ValuesIn(list_commands()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace nightcity::nightbake
