// Lines and lists that reports in words are made of.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace nightcity::bake {

/// Returns a line of a report: its name, padded to a column, then the value.
std::string report_line(const char* name, const std::string& value);

/// Returns "12 wall, 3 roof", the most frequent first, or "none".
std::string in_words(const std::map<std::string, std::size_t>& counts);

/// Rounds a length or an area of a report to tenths.
double round_to_tenths(double amount);
/// Returns the amounts, rounded to tenths.
std::map<std::string, double> round_to_tenths(std::map<std::string, double> amounts);

}  // namespace nightcity::bake
