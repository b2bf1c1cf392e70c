// The subcommands of nightview, one per file. Each function declares a subcommand and its options;
// the subcommand's callback does the work. Callbacks throw nightcity::Error (exit code 1,
// UsageError 2) and print results to stdout; progress and messages go to stderr.
#pragma once

namespace CLI {
class App;
}

namespace nightcity::nightview {

void add_render_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_upward_command(CLI::App& app);
void add_rays_command(CLI::App& app);
void add_devices_command(CLI::App& app);
void add_sweep_command(CLI::App& app);
void add_flight_command(CLI::App& app);
void add_record_command(CLI::App& app);
void add_strategies_command(CLI::App& app);
void add_vehicles_command(CLI::App& app);
void add_price_command(CLI::App& app);
void add_presets_command(CLI::App& app);

}  // namespace nightcity::nightview
