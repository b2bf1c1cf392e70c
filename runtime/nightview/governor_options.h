// The options of a governor, declared once.
#pragma once

#include <CLI/CLI.hpp>

#include "runtime/render/governor.h"

namespace nightcity::nightview {

/// Declares --budget-ms and --target-error.
void declare_governor(CLI::App& command, render::GovernorOptions& options);

}  // namespace nightcity::nightview
