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

}  // namespace nightcity::bake
