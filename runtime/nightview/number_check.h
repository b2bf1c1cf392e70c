// The check of options that take a number with a fraction.
#pragma once

#include <CLI/CLI.hpp>

namespace nightcity::nightview {

/// Returns a check that accepts numbers from `min` to `max`, both included. CLI::Range would let
/// NaN pass.
CLI::Validator number_from(double min, double max);

/// Returns the check of an exposure in EV100: from moonless nights to beyond the midday sun.
CLI::Validator exposure_check();

}  // namespace nightcity::nightview
