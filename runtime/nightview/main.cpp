// nightview: baked city in, night picture out. The program's frame; the work is in the subcommands.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "formats/error.h"
#include "runtime/nightview/commands.h"

namespace nightcity {
namespace {

// stdout belongs to results, so that they can be piped; everything else goes to stderr.
void start_log() {
  auto logger = spdlog::stderr_color_mt("nightview");
  logger->set_pattern("nightview: %^%l%$: %v");
  spdlog::set_default_logger(logger);
}

// "nightview SCENE.glb ..." is short for "nightview view SCENE.glb ...". Reversed, as CLI11 wants them.
std::vector<std::string> with_default_command(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_file = [](const std::string& text) {
    const std::string extension = std::filesystem::path(text).extension().string();
    return extension == ".glb" || extension == ".gltf";
  };
  const auto is_command = [&](const std::string& text) {
    return !app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(text); }).empty();
  };
  if (std::none_of(arguments.begin(), arguments.end(), is_command) &&
      std::any_of(arguments.begin(), arguments.end(), is_file))
    arguments.insert(arguments.begin(), "view");
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

int run(int argc, char** argv) {
  CLI::App app{"nightview: renders a baked city at night, with every light a real one"};
  app.name("nightview");
  app.set_version_flag("--version", "nightview " NIGHTCITY_VERSION);
  app.footer(
      "Exit codes: 0 done; 1 an input is missing, broken or unusable, or an output cannot be "
      "written, or "
      "there is no\n"
      "usable Vulkan device; 2 the command line is wrong.");
  app.require_subcommand(1);
  app.fallthrough();

  bool verbose = false, quiet = false;
  auto* verbose_flag = app.add_flag("-v,--verbose", verbose, "Tell more of what is done");
  app.add_flag("-q,--quiet", quiet, "Errors and results only")->excludes(verbose_flag);
  app.parse_complete_callback([&] {
    if (verbose) spdlog::set_level(spdlog::level::debug);
    if (quiet) spdlog::set_level(spdlog::level::err);
  });
  add_render_command(app);
  add_view_command(app);
  add_compare_command(app);
  add_bench_command(app);
  add_upward_command(app);
  add_devices_command(app);
  add_sweep_command(app);
  add_flight_command(app);
  add_strategies_command(app);
  add_vehicles_command(app);

  try {
    std::vector<std::string> arguments = with_default_command(app, argc, argv);
    app.parse(arguments);
    return static_cast<int>(ExitCode::ok);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    spdlog::error("{} (see nightview --help)", error.what());
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
  }
  return static_cast<int>(ExitCode::bad_data);
}
