// nightbake: open city data in, a photometric night scene out. The program's frame; the work is in the
// subcommands.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "formats/error.h"
#include "tools/nightbake/commands.h"

namespace nightcity {
namespace {

// stdout belongs to results, so that they can be piped; everything else goes to stderr.
void start_log() {
  auto logger = spdlog::stderr_color_mt("nightbake");
  logger->set_pattern("nightbake: %^%l%$: %v");
  spdlog::set_default_logger(logger);
}

int run(int argc, char** argv) {
  CLI::App app{
      "nightbake: open city data (CityGML, OpenStreetMap) in, a photometric night scene out"};
  app.name("nightbake");
  app.set_version_flag("--version", "nightbake " NIGHTCITY_VERSION);
  app.footer(
      "Exit codes: 0 done; 1 an input is missing, broken or unusable, or an output cannot be "
      "written;\n"
      "2 the command line or a recipe's keys are wrong.");
  app.require_subcommand(1);
  app.fallthrough();  // so that --quiet works after the subcommand's name too

  add_run_command(app);
  add_recipe_command(app);
  add_inspect_command(app);
  add_readers_command(app);
  add_town_command(app);
  add_elevate_command(app);
  add_lamps_command(app);
  add_layout_command(app);
  add_traffic_command(app);
  add_windows_command(app);
  add_lights_command(app);

  bool verbose = false, quiet = false;
  auto* verbose_flag = app.add_flag("-v,--verbose", verbose, "Tell more of what is done");
  app.add_flag("-q,--quiet", quiet, "Errors and results only")->excludes(verbose_flag);
  app.parse_complete_callback([&] {
    if (verbose) spdlog::set_level(spdlog::level::debug);
    if (quiet) spdlog::set_level(spdlog::level::err);
  });

  try {
    app.parse(argc, argv);
    return static_cast<int>(ExitCode::ok);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    spdlog::error("{} (see nightbake --help)", error.what());
    return static_cast<int>(ExitCode::bad_usage);
  }
}

}  // namespace
}  // namespace nightcity

int main(int argc, char** argv) {
  using nightcity::ExitCode;
  try {
    nightcity::start_log();
    return nightcity::run(argc, argv);
  } catch (const nightcity::Error& error) {
    spdlog::error("{}", error.what());
    return static_cast<int>(error.exit_code());
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
  } catch (...) {
    // libcitygml lets xerces exceptions through, which derive from nothing.
    spdlog::error("an unknown exception ended the work");
  }
  return static_cast<int>(ExitCode::bad_data);
}
