// The frame that both programs share: command line, log, exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace nightcity::program {

/// The parts in which one program differs from the other.
struct Program {
  std::string name;         // as users type it, and in front of each message
  std::string description;  // what it does, to follow the name: "renders a city"
  std::string version;      // without the name: "0.1.0"
  std::string exit_codes;   // "0 done; 1 ...", for --help and the manual page
  /// Declares the subcommands. Their callbacks do the work: they throw nightcity::Error, print
  /// results to stdout, and send messages to stderr through spdlog.
  std::function<void(CLI::App&)> add_commands;
  /// Optional: completes the arguments before they are parsed (a default subcommand).
  std::function<std::vector<std::string>(const CLI::App&, std::vector<std::string>)>
      complete_arguments;
};

/// Runs the program that `program` describes and returns its exit code (see ExitCode in
/// formats/error.h).
///
/// Adds --help, --version, -v (debug messages) and -q (errors only), which are accepted after a
/// subcommand's name too, and the hidden --man-pages FOLDER, which writes the manual pages. Every
/// exception ends as one line on stderr: a nightcity::Error with its own exit code, a wrong command
/// line with ExitCode::bad_usage, any other exception, even one that derives from nothing, with
/// ExitCode::bad_data. Results that stdout cannot take (a full disk behind a pipe) are an error
/// too.
int run_program(const Program& program, int argc, const char* const* argv);

}  // namespace nightcity::program
