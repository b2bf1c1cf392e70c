#include "formats/program/run_program.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>

#include "formats/error.h"
#include "formats/program/man_page.h"
#include "formats/program/nearest_word.h"
#include "formats/program/output.h"
#include "formats/signals.h"

namespace nightcity::program {
namespace {

// stdout belongs to results, so that they can be piped; everything else goes to stderr.
void start_log(const std::string& name) {
  auto logger = std::make_shared<spdlog::logger>(
      name, std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern(name + ": %^%l%$: %v");
  spdlog::set_default_logger(std::move(logger));
}

void add_common_options(CLI::App& app, const Program& program) {
  app.name(program.name);
  app.set_version_flag("--version", program.name + " " + program.version,
                       "Print the program's version and exit");
  app.footer("Exit codes: " + program.exit_codes);
  app.require_subcommand(1);
  app.fallthrough();  // so that --quiet works after the subcommand's name too

  struct Level {
    bool verbose = false, quiet = false;
  };
  const auto level = std::make_shared<Level>();
  auto* verbose = app.add_flag("-v,--verbose", level->verbose, "Print more about what is done");
  app.add_flag("-q,--quiet", level->quiet, "Print errors and results only")->excludes(verbose);
  app.parse_complete_callback([level] {
    spdlog::set_level(level->verbose ? spdlog::level::debug
                      : level->quiet ? spdlog::level::err
                                     : spdlog::level::info);
  });
}

// A hidden option, for the build: it ends the parsing, so that no subcommand is asked for.
void add_man_pages_option(CLI::App& app, const Program& program) {
  app.add_option_function<std::string>(
         "--man-pages",
         [&app, &program](const std::string& folder) {
           write_man_pages(program, app, folder);
           throw CLI::Success();
         },
         "Write the manual pages to this folder and exit")
      ->group("");
}

// stdout is buffered: a disk that is full shows only when the buffer is written.
void require_written_results() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw Error("standard output", "cannot be written");
}

// Returns what is wrong where the first word of the command line is no command; "" elsewhere.
std::string find_unknown_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto first = std::find_if(arguments.begin(), arguments.end(), [](const std::string& text) {
    return !text.empty() && text.front() != '-';
  });
  if (first == arguments.end()) return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->check_name(*first)) return {};
    names.push_back(command->get_name());
  }
  const std::string nearest = find_nearest_word(*first, names);
  return "there is no command \"" + *first + '"' +
         (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?");
}

ExitCode parse_and_run(const Program& program, int argc, const char* const* argv) {
  CLI::App app{program.name + " " + program.description};
  add_common_options(app, program);
  program.add_commands(app);
  add_man_pages_option(app, program);

  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (program.complete_arguments) arguments = program.complete_arguments(app, std::move(arguments));
  const std::string unknown = find_unknown_command(app, arguments);
  std::reverse(arguments.begin(), arguments.end());  // the order in which CLI11 takes a vector
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success)) {
      spdlog::error("{} (see {} --help)", unknown.empty() ? error.what() : unknown, program.name);
      return ExitCode::bad_usage;
    }
    app.exit(error);  // prints the help or the version
  }
  require_written_results();
  return ExitCode::ok;
}

}  // namespace

int run_program(const Program& program, int argc, const char* const* argv) {
  ExitCode code = ExitCode::bad_data;
  install_signal_handlers(program.name.c_str());
  try {
    start_log(program.name);
    code = parse_and_run(program, argc, argv);
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    code = error.exit_code();
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
  } catch (...) {
    // xerces' exceptions, for one, derive from nothing.
    spdlog::error("an unknown exception ended the work");
  }
  if (code == ExitCode::ok)
    keep_made_folders();
  else
    remove_made_folders();
  return static_cast<int>(code);
}

}  // namespace nightcity::program
