// The checks of options that take a number.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace nightcity::program {

/// Returns a check that accepts decimal numbers from `min` to `max`, both included, as read_number
/// reads them. CLI::Range would let NaN pass, and blanks before the number.
CLI::Validator number_from(double min, double max);

/// Returns a check that accepts whole decimal numbers from `min` to `max`, both included, without
/// leading zeros. CLI::Range would take 010 for eight, 0x10 for sixteen, and blanks.
CLI::Validator count_from(std::uint64_t min, std::uint64_t max);

}  // namespace nightcity::program
