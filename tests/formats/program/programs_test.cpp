// The help and the manual pages of both programs, as they are built here.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "support/process.h"
#include "support/temp_folder.h"

namespace nightcity::program {
namespace {

using test::Outcome;
using test::TempFolder;

class Programs : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::filesystem::path(NIGHTCITY_BUILD_DIR) / GetParam()))
      GTEST_SKIP() << GetParam() << " is not built";
    const Outcome outcome = run("--man-pages" + test::quoted(pages_.path()));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(outcome.out + outcome.err, "");
  }

  static Outcome run(const std::string& arguments) {
    return test::run_program(GetParam(), arguments);
  }

  // The subcommands that have a page; "" is the program itself.
  std::vector<std::string> find_commands() const {
    std::vector<std::string> commands;
    for (const auto& entry : std::filesystem::directory_iterator(pages_.path())) {
      const std::string stem = entry.path().stem().string();
      commands.push_back(stem == GetParam() ? "" : stem.substr(GetParam().size() + 1));
    }
    return commands;
  }

  std::filesystem::path page_path(const std::string& command) const {
    return pages_ / (GetParam() + (command.empty() ? "" : "-" + command) + ".1");
  }
  // The page as a reader sees it: without roff's escapes of hyphens and quotes.
  std::string read_page(const std::string& command) const {
    std::string page = test::read_text(page_path(command));
    page = std::regex_replace(page, std::regex(R"(\\-)"), "-");
    return std::regex_replace(page, std::regex(R"(\\\(aq)"), "'");
  }

  TempFolder pages_;
};

INSTANTIATE_TEST_SUITE_P(Both, Programs, testing::Values("nightbake", "nightview"),
                         [](const auto& info) { return info.param; });

TEST_P(Programs, HaveAPageForEveryCommandThatHelpLists) {
  const std::vector<std::string> commands = find_commands();
  const std::string help = run("--help").out;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::size_t listed = 0;
  const std::regex entry("  ([a-z]+)(?:, [a-z]+)* .*");  // old names follow
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, match, entry)) {
      ++listed;
      EXPECT_EQ(std::count(commands.begin(), commands.end(), match[1]), 1) << match[1];
    }
  EXPECT_GE(listed, 8u);
  EXPECT_EQ(listed + 1, commands.size());
}

TEST_P(Programs, HaveEveryOptionOfHelpInItsPage) {
  const std::regex option(R"(\n {2,4}(-[^ ]+))");
  for (const std::string& command : find_commands()) {
    const Outcome help = run(command + " --help");
    ASSERT_EQ(help.exit_code, 0) << help.err;
    const std::string page = read_page(command);
    std::size_t options = 0;
    for (std::sregex_iterator i(help.out.begin(), help.out.end(), option), end; i != end; ++i) {
      ++options;
      EXPECT_NE(page.find("\n.B " + (*i)[1].str()), std::string::npos) << command << " " << (*i)[1];
    }
    EXPECT_GE(options, 1u) << command << ": --help itself is one";
  }
}

TEST_P(Programs, SayWhatEachArgumentAndOptionMeans) {
  const std::regex entry(R"(\n\.TP\n\.BR? ([^\n]*)\n([^\n]*))");
  for (const std::string& command : find_commands()) {
    const std::string page = read_page(command);
    for (std::sregex_iterator i(page.begin(), page.end(), entry), end; i != end; ++i) {
      const std::string text = (*i)[2];
      EXPECT_TRUE(text.size() > 3 && text[0] != '.') << command << " " << (*i)[1] << " has no text";
    }
  }
}

TEST_P(Programs, GiveAnExampleOfEveryCommand) {
  for (const std::string& command : find_commands()) {
    if (command.empty()) continue;
    const std::string call = GetParam() + " " + command + " ";
    const std::string help = run(command + " --help").out;
    EXPECT_NE(help.find(call, std::min(help.find("Example"), help.size())), std::string::npos)
        << command << ": its help has no example that starts with " << call;
    const std::string page = read_page(command);
    const std::size_t examples = page.find(".SH EXAMPLES\n");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_NE(page.find("\n" + call, examples), std::string::npos) << command;
  }
}

TEST_P(Programs, WritePagesThatManTakesWithoutAWarning) {
  if (std::system("command -v man >/dev/null && command -v groff >/dev/null") != 0)
    GTEST_SKIP() << "man is not installed";
  for (const std::string& command : find_commands()) {
    const TempFolder folder;
    const std::string call = "LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l" +
                             test::quoted(page_path(command)) + ">" + test::quoted(folder / "out") +
                             "2>" + test::quoted(folder / "err");
    EXPECT_EQ(std::system(call.c_str()), 0);
    EXPECT_EQ(test::read_text(folder / "err"), "") << command;
    EXPECT_NE(test::read_text(folder / "out").find("SYNOPSIS"), std::string::npos) << command;
  }
}

TEST_P(Programs, FailWhereStdoutTakesNoResults) {
  const std::string call =
      std::string("'") + NIGHTCITY_BUILD_DIR + "/" + GetParam() + "' --help >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(call.c_str())), 1);
}

}  // namespace
}  // namespace nightcity::program
