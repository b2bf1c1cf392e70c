#include "formats/program/man_page.h"

#include <gtest/gtest.h>

#include "formats/program/run_program.h"
#include "support/temp_folder.h"

namespace nightcity::program {
namespace {

class ManPage : public testing::Test {
 protected:
  ManPage() : app_("lamplighter lights lamps") {
    program_.name = "lamplighter";
    program_.description = "lights lamps";
    program_.version = "1.2.3";
    program_.exit_codes = "0 done; 1 failed";
    app_.name("lamplighter");
    command_ = app_.add_subcommand("work", "Light the lamps of a street");
    command_->add_option("street,--street", street_, "The street's name")->required();
    command_->add_option("--lamp-count", lamps_, "Lamps to light")->check(CLI::Range(1, 99));
    auto* group = command_->add_option_group("fuel", "One of these");
    group->add_flag("--gas", burns_gas_, "Burn gas");
    command_->add_option("--secret", lamps_, "Not for users")->group("");
  }

  std::string make_command_page(const std::string& footer) {
    command_->footer(footer);
    return to_man_page(program_, app_, *command_);
  }
  static void expect_part(const std::string& page, const std::string& part) {
    EXPECT_NE(page.find(part), std::string::npos) << part << "\nis not in\n" << page;
  }

  Program program_;
  CLI::App app_;
  CLI::App* command_;
  std::string street_;
  int lamps_ = 0;
  bool burns_gas_ = false;
};

TEST_F(ManPage, HoldsEveryArgumentAndOptionWithItsText) {
  const std::string page = make_command_page("");
  expect_part(page, ".TH LAMPLIGHTER\\-WORK 1 \"\" \"lamplighter 1.2.3\"");
  expect_part(page, ".SH NAME\nlamplighter\\-work \\- Light the lamps of a street\n");
  expect_part(page, ".SH SYNOPSIS\n.B lamplighter work\n[\\fIOPTIONS\\fR] street\n");
  expect_part(page, ".SH ARGUMENTS\n.TP\n.B street TEXT REQUIRED\nThe street\\(aqs name\n");
  expect_part(page, ".TP\n.B \\-\\-street TEXT REQUIRED\nThe street\\(aqs name\n");
  expect_part(page, ".TP\n.B \\-\\-lamp\\-count INT:INT in [1 \\- 99]\nLamps to light\n");
  expect_part(page, ".PP\nOne of these:\n.TP\n.B \\-\\-gas\nBurn gas\n");
  expect_part(page, ".SH EXIT STATUS\n0 done; 1 failed\n");
  EXPECT_EQ(page.find("secret"), std::string::npos) << "--help does not print it either";
}

TEST_F(ManPage, PutsExamplesIntoASectionOfTheirOwn) {
  const std::string several = make_command_page(
      "Lamps burn gas.\nExamples:\n  lamplighter work Main\n  lamplighter work 'High St' -q");
  expect_part(several, "Light the lamps of a street.\nLamps burn gas.\n.SH");
  expect_part(several,
              ".SH EXAMPLES\n.EX\nlamplighter work Main\nlamplighter work \\(aqHigh St\\(aq "
              "\\-q\n.EE\n");
  expect_part(make_command_page("Example: lamplighter work Main"),
              ".SH EXAMPLES\n.EX\nlamplighter work Main\n.EE\n");
}

TEST_F(ManPage, PrintsTextThatRoffWouldTakeForACommand) {
  const std::string page = make_command_page(".so /etc/passwd\n'hidden\na\\b");
  expect_part(page, "\n\\&.so /etc/passwd\n\\&\\(aqhidden\na\\eb\n");
}

TEST_F(ManPage, OfTheProgramListsItsCommands) {
  const std::string page = to_man_page(program_, app_);
  expect_part(page, ".TP\n.BR lamplighter\\-work (1)\nLight the lamps of a street\n");
  expect_part(page, ".SH SEE ALSO\n.BR lamplighter\\-work (1)\n");
}

TEST_F(ManPage, IsWrittenForTheProgramAndEachCommand) {
  const test::TempFolder folder;
  write_man_pages(program_, app_, folder / "man");
  EXPECT_EQ(test::read_text(folder / "man/lamplighter.1"), to_man_page(program_, app_));
  EXPECT_EQ(test::read_text(folder / "man/lamplighter-work.1"),
            to_man_page(program_, app_, *command_));
}

}  // namespace
}  // namespace nightcity::program
