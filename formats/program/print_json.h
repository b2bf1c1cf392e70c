// Results as JSON on stdout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nightcity::program {

/// Returns `value` as indented JSON. Bytes that are no UTF-8 (ids and names come from strangers'
/// files) become U+FFFD: JSON may not hold them.
std::string to_json_text(const nlohmann::json& value);
std::string to_json_text(const nlohmann::ordered_json& value);

/// Prints `to_json_text(value)` and a newline to stdout.
void print_json(const nlohmann::json& value);
void print_json(const nlohmann::ordered_json& value);

}  // namespace nightcity::program
