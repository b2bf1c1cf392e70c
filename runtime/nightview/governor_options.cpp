#include "runtime/nightview/governor_options.h"

#include "formats/program/number_check.h"

namespace nightcity::nightview {

void declare_governor(CLI::App& command, render::GovernorOptions& options) {
  command
      .add_option("--budget-ms", options.budget_ms,
                  "Milliseconds that a frame may take by the device's clock: candidates and "
                  "neighbours, at most as many as the settings ask for, are chosen for this scene "
                  "and device; 0 = no budget")
      ->capture_default_str()
      ->check(program::number_from(0, 1e6));
  command
      .add_option("--target-error", options.target_error,
                  "Noise that is small enough, as relative RMSE (0.05): no more work than that "
                  "needs is done; 0 = no target")
      ->capture_default_str()
      ->check(program::number_from(0, 1e6));
}

}  // namespace nightcity::nightview
