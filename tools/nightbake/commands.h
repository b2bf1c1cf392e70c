// The subcommands of nightbake, each in its own file. Each function declares the options of a
// subcommand and returns; the work is done by the callback. Callbacks throw nightcity::Error (exit
// code 1, UsageError 2) and print results to stdout; progress and messages go to stderr.
#pragma once

namespace CLI {
class App;
}

namespace nightcity::nightbake {

void add_run_command(CLI::App& app);
void add_new_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_merge_command(CLI::App& app);
void add_price_command(CLI::App& app);
void add_recipe_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_town_command(CLI::App& app);
void add_readers_command(CLI::App& app);
void add_traffic_command(CLI::App& app);
void add_elevate_command(CLI::App& app);
void add_lamps_command(CLI::App& app);
void add_layout_command(CLI::App& app);
void add_windows_command(CLI::App& app);
void add_lights_command(CLI::App& app);

}  // namespace nightcity::nightbake
